// SPDX-License-Identifier: MIT
// Relations between the fluid of one rank and that of the whole case: its tiles, rows and cuts.
#pragma once

#include "hyoryu/fluid/fluid.hpp"

namespace hyoryu {

/// Assembles all body particles on rank 0 from the ranks that set those in their tiles. Called by
/// all ranks; the other ranks keep their own.
Store whole_bodies(const Fluid& fluid);

/// Cuts by which all ranks have about the same number of fluid particles; `fluid`: those that this
/// one has. Called by all ranks.
Cuts even_cuts(const TileLattice& lattice, std::span<const Vec3> fluid, Comm& comm);

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
