// SPDX-License-Identifier: MIT
// Which particles may be near a gauge: a search over the bounds of tiles, groups of tiles first.
#pragma once

#include "hyoryu/core/parallel.hpp"
#include "hyoryu/core/tiles.hpp"
#include "hyoryu/scene/shapes.hpp"

#include <algorithm>
#include <vector>

namespace hyoryu {

/// Where the particles of the tiles of one kind are now [m].
struct TileBounds {
    std::vector<Bounds> tile;  // of the particles of each tile
    std::vector<Bounds> group; // of `tiles_of_group` tiles that follow each other
};

/// Tiles that follow each other along the Morton curve lie close together.
inline constexpr Index tiles_of_group = 16;

/// Measures the bounds at the present positions; lists may be older.
TileBounds measure_bounds(const Tiles& tiles, std::span<const Vec3> x);

/// The bounds of particles at the positions at which they were sorted.
TileBounds sorted_bounds(const Tiles& tiles);

/// Middle and half of the edges of bounds [m].
struct TileExtent {
    Vec3 middle, half;
};
TileExtent extent_of(const Bounds& bounds);

/// Appends the rows of particles that may be near, in the order of their slots:
/// `may_be_near(extent)` says false only of extents that hold no point that is.
template <class Test>
void append_rows_near(const Tiles& tiles, const TileBounds& bounds, std::span<const Vec3> x,
                      const Test& may_be_near, std::vector<Index>& rows)
{
    for (std::size_t group = 0; group < bounds.group.size(); ++group) {
        if (!may_be_near(extent_of(bounds.group[group]))) {
            continue;
        }
        const Index begin = static_cast<Index>(group) * tiles_of_group;
        const Index end = std::min(begin + tiles_of_group, tiles.tiles());
        for (Index t = begin; t < end; ++t) {
            if (!may_be_near(extent_of(bounds.tile[at(t)]))) {
                continue;
            }
            for (Index k = tiles.start[at(t)]; k < tiles.start[at(t + 1)]; ++k) {
                const Index row = tiles.row[at(k)];
                if (may_be_near(TileExtent{x[at(row)], Vec3::Zero()})) {
                    rows.push_back(row);
                }
            }
        }
    }
}

} // namespace hyoryu
