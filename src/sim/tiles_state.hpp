// SPDX-License-Identifier: MIT
// The datasets of tiles, and the parts of a restart that ranks share with one process.
#pragma once

#include "hyoryu/core/state.hpp"
#include "hyoryu/sim/simulation.hpp"

namespace hyoryu {

/// Tiles: Tiles of the last list build, from which the lists are built again; constant for a
/// writer.
template <class State, class Tiles>
void describe_tiles(State& state, Tiles& tiles, const std::string& name)
{
    state.list(name + "/number", "", tiles.tile);
    state.list(name + "/start", "", tiles.start);
    state.list(name + "/row", "", tiles.row);
    state.list(name + "/x", "", tiles.x);
    state.list(name + "/y", "", tiles.y);
    state.list(name + "/z", "", tiles.z);
}

/// Lists are made from tiles by index: those of a damaged checkpoint would lead anywhere. Throws
/// IoError if tiles do not fit the rows of their particles.
void check_tiles(const Tiles& tiles, Rows rows);

/// Throws IoError if a state has more fluid particles than its case can have.
void expect_particles_of_case(const Simulation& sim, Index particles);

/// Puts a state into a simulation: a rank gets the fluid particles and tiles of its range, and all
/// other data as a single process has them. Called by all ranks.
void restore_share(Simulation& sim, const Snapshot& snapshot);

} // namespace hyoryu
