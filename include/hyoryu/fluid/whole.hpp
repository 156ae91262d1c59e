// SPDX-License-Identifier: MIT
// From the fluid of one of several processes to that of one, and back: what is read and written,
// such as a checkpoint, is whole and shows neither that there were ranks nor how many.
#pragma once

#include "hyoryu/fluid/fluid.hpp"

namespace hyoryu {

/// The parts of a fluid in which the store of a rank differs from that of one process.
struct WholeFluid {
    Particles particles;
    Tiles fluid, wall, body;
};

/// Gathers the particles and tiles of all ranks on rank 0, in the order of one process. Called by
/// all ranks; empty on the others.
WholeFluid gather_whole(const Fluid& fluid);

/// Exchanges the parts of a fluid with those of another, and its ghosts.
void swap_parts(Fluid& fluid, WholeFluid& whole, std::unique_ptr<Ghosts>& ghosts);

/// Cuts by which all ranks have about the same number of fluid particles.
Cuts even_cuts(const TileLattice& lattice, std::span<const Vec3> fluid, int ranks);

/// Leaves the tiles of a range.
void keep_tiles(Tiles& tiles, const TileRange& own);

/// Where the wall rows of a rank are among those of one process. Rows of walls that move come first
/// and are on all ranks; then come those of fixed walls, rank after rank.
struct WallRows {
    Index first = 0; // of the fixed walls of this rank
    Index all = 0;   // rows
};
/// Called by all ranks.
WallRows wall_rows(const Fluid& fluid);

} // namespace hyoryu
