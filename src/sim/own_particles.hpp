// SPDX-License-Identifier: MIT
// The particles that a process begins with: all of a filling, or those of its tiles.
#pragma once

#include "hyoryu/sim/simulation.hpp"

namespace hyoryu {

/// Whether the wall of an index moves.
bool is_moving(const Scene& scene, std::int32_t wall);

/// The particles of fixed walls by tile, without their maker. Several processes join their results:
/// all get the particles of all. `comm` is null for one process.
FixedWalls find_fixed_walls(const Scene& scene, const Filling& filling, const TileLattice& lattice,
                            Comm* comm);

/// Sends the fluid of a filling to the ranks that own its tiles, and moving walls to all ranks.
/// Returns the cuts of the fluid. Called by all ranks.
Cuts deal_out(const Scene& scene, const TileLattice& lattice, Comm& comm, Filling& filling);

} // namespace hyoryu
