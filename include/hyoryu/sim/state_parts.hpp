// SPDX-License-Identifier: MIT
// A state in parts: what all ranks of a run have alike, and the particles, of which each part has
// those of a range of tiles. Parts in the order of their ranges, put together, are the state of one
// process; so a state can be taken up by any number of ranks, whatever number has left it.
#pragma once

#include "hyoryu/core/snapshot.hpp"
#include "hyoryu/ranks/groups.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <functional>

namespace hyoryu {

/// The dataset with the rows of fixed walls that a part has. A whole state has none.
inline constexpr const char* rows_of_fixed_walls = "wall/fixed";

/// Takes the particles of a rank out of its state.
Snapshot take_particles(const Simulation& sim, Snapshot& state);

/// The same for a state whose arrays are made on demand.
StateOnDemand take_particles(const Simulation& sim, StateOnDemand& state);

/// Appends the particles of the next part; `all` is empty before the first. Throws IoError if they
/// do not belong together.
void append_particles(const Simulation& sim, Snapshot& all, Snapshot next);

/// Puts particles, all of them, back into a state.
void put_particles(Snapshot& state, Snapshot particles);

/// The particles of each group of ranks, on its leader. Called by all ranks.
Snapshot gather_particles(const Simulation& sim, Comm& comm, const Groups& groups, Snapshot own);

/// The state of all ranks as that of one process, on rank 0. Called by all ranks.
Snapshot save_whole(const Simulation& sim, Comm& comm);

/// A state that ranks take up.
struct StateParts {
    Snapshot common; // of rank 0; not looked at on the others
    int count = 0;   // parts of particles
    /// Reads a part. Rank r of n is asked for the parts r, r + n, ..., for some of them twice.
    std::function<Snapshot(int part)> particles;
};

/// A state of one process; not looked at on other ranks than 0.
StateParts one_part(const Simulation& sim, Snapshot state);

/// Puts a state into a simulation that was made from the same case. Called by all ranks: each
/// receives the fluid of its tiles, of which all have about the same number of particles. Throws
/// IoError, on the rank that finds the fault, if the state does not fit the case.
void restore(Simulation& sim, Comm* comm, const StateParts& state);

} // namespace hyoryu
