// SPDX-License-Identifier: MIT
// Schedule of neighbour lists: the displacements that make lists invalid, and the optimal skin.
#pragma once

#include "hyoryu/core/tiles.hpp"

namespace hyoryu {

/// Skins of the lists beyond the support, separately for pairs of fluid particles, which mostly
/// move together, and for pairs with a solid, along which the fluid slips.
struct Skins {
    real fluid = 0; // [m]
    real solid = 0; // [m]
};

/// Largest motions since the lists were made [m].
struct Displacement {
    real fluid = 0; // of two fluid particles of neighbouring tiles, relative to each other
    real solid = 0; // of such a pair with a solid particle
    real absolute = 0;
};

/// Bounds of the displacements of the particles of a tile.
struct DisplacementBox {
    Vec3 low, high;
};

/// The tiles that touch each tile of one set, among those of another; -1 where none is.
using TileTouch = std::array<std::int32_t, 27>;

/// Room for the motions of one kind, and which tiles touch.
struct DisplacementSpace {
    std::vector<DisplacementBox> box;         // by tile
    std::vector<TileTouch> fluid, wall, body; // the tiles of each kind that touch one of this
};

/// The tiles of `others` that touch each of `tiles`.
void find_touching(const Tiles& tiles, const Tiles& others, std::vector<TileTouch>& touch);

/// Bounds of the displacements x - (place when sorted), tile by tile; the largest length.
real bound_motion(const Tiles& tiles, std::span<const Vec3> x, std::vector<DisplacementBox>& box);

/// Largest relative displacement between points of tiles that touch.
real relative_motion(const std::vector<DisplacementBox>& boxes,
                     const std::vector<DisplacementBox>& others,
                     const std::vector<TileTouch>& touch);

/// List entries by the kind of pair, padding included.
struct EntryCounts {
    Index fluid = 0; // fluid <- fluid
    Index solid = 0; // all others
};

/// The skins of the first lists, before anything has moved.
Skins first_skins(real spacing);

/// The skins of least cost per step, if motions continue as over the `steps` since the last lists.
/// A larger skin gives longer lists, which every step processes, but fewer rebuilds. Depends on
/// motions and counts only, never on time.
Skins best_skins(const Displacement& motion, long long steps, const EntryCounts& entries,
                 const Skins& now, real support, real spacing);

} // namespace hyoryu
