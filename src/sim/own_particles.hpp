// SPDX-License-Identifier: MIT
// The particles that a process begins with: all of a filling, or those of its tiles.
#pragma once

#include "hyoryu/sim/simulation.hpp"

namespace hyoryu {

/// Whether the wall of an index moves.
bool is_moving(const Scene& scene, std::int32_t wall);

/// Where the particles of walls that do not move are, without what makes them. Of several processes
/// all get those of all; `comm` is null for one.
FixedWalls find_fixed_walls(const Scene& scene, const Filling& filling, const TileLattice& lattice,
                            Comm* comm);

/// Sends the fluid of a filling to those in whose tiles it is, and the walls that move to all.
/// Returns the cuts of the fluid. Called by all ranks.
Cuts deal_out(const Scene& scene, const TileLattice& lattice, Comm& comm, Filling& filling);

} // namespace hyoryu
