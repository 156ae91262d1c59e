// SPDX-License-Identifier: MIT
// What of the fluid of a rank differs from that of one process: which tiles and rows it has.
#pragma once

#include "hyoryu/fluid/fluid.hpp"

namespace hyoryu {

/// The body particles as one process has them, on rank 0: each rank has set those in its tiles.
/// Called by all ranks; the others get their own.
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
