// SPDX-License-Identifier: MIT
// A state in parts: the data that is the same on all ranks, and the particles, of which each part
// has those of a range of tiles. The parts, concatenated in the order of their ranges, are the
// state of one process. Therefore any number of ranks can restore a state that any other number has
// saved.
#pragma once

#include "hyoryu/core/snapshot.hpp"
#include "hyoryu/ranks/groups.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <functional>

namespace hyoryu {

/// Name of the dataset with the number of rows of fixed walls in a part. A whole state has none.
inline constexpr const char* rows_of_fixed_walls = "wall/fixed";

/// Moves the datasets of particles out of the state of a rank.
Snapshot take_particles(const Simulation& sim, Snapshot& state);

/// The same for a state whose arrays are made on demand.
StateOnDemand take_particles(const Simulation& sim, StateOnDemand& state);

/// Appends the particles of the next part; `all` is empty before the first. Throws IoError if they
/// do not belong together.
void append_particles(const Simulation& sim, Snapshot& all, Snapshot next);

/// Moves the particles of all parts back into a state.
void put_particles(Snapshot& state, Snapshot particles);

/// The particles of each group of ranks, on its leader. Called by all ranks.
Snapshot gather_particles(const Simulation& sim, Comm& comm, const Groups& groups, Snapshot own);

/// The state of all ranks as that of one process, on rank 0. Called by all ranks.
Snapshot save_whole(const Simulation& sim, Comm& comm);

/// A state to restore.
struct StateParts {
    Snapshot common; // data of all ranks; used on rank 0 only
    int count = 0;   // number of parts
    /// Reads the particles of a part. Rank r of n reads the parts r, r + n, ..., each of them
    /// twice.
    std::function<Snapshot(int part)> particles;
};

/// A part as restore() reads it: a copy first, then the part itself, which is not kept.
std::function<Snapshot(int part)> given_twice(Snapshot part);

/// The state of one process as a single part; used on rank 0 only, for one restore().
StateParts one_part(const Simulation& sim, Snapshot state);

/// Puts a state into a simulation that was made from the same case. Called by all ranks: each
/// receives the fluid of its tiles, of which all have about the same number of particles. Throws
/// IoError, on the rank that finds the fault, if the state does not fit the case.
void restore(Simulation& sim, Comm* comm, const StateParts& state);

} // namespace hyoryu
