// SPDX-License-Identifier: MIT
#include "gauge_search.hpp"

namespace hyoryu {

namespace {

// The bounds of every tile, by a function of its number, and of the groups.
template <class BoundsOfTile>
TileBounds bounds_by_tile(const Tiles& tiles, const BoundsOfTile& bounds_of_tile)
{
    TileBounds bounds;
    bounds.tile.resize(tiles.tile.size());
    bounds.group.resize(at((tiles.tiles() + tiles_of_group - 1) / tiles_of_group));
    parallel_blocks(0, static_cast<Index>(bounds.group.size()), [&](Index group) {
        const Index end = std::min((group + 1) * tiles_of_group, tiles.tiles());
        for (Index t = group * tiles_of_group; t < end; ++t) {
            bounds.tile[at(t)] = bounds_of_tile(t);
            bounds.group[at(group)].add(bounds.tile[at(t)].min);
            bounds.group[at(group)].add(bounds.tile[at(t)].max);
        }
    });
    return bounds;
}

} // namespace

TileBounds measure_bounds(const Tiles& tiles, std::span<const Vec3> x)
{
    return bounds_by_tile(tiles, [&](Index t) {
        Bounds bounds;
        for (Index k = tiles.start[at(t)]; k < tiles.start[at(t + 1)]; ++k) {
            bounds.add(x[at(tiles.row[at(k)])]);
        }
        return bounds;
    });
}

TileBounds sorted_bounds(const Tiles& tiles)
{
    return bounds_by_tile(tiles, [&](Index t) {
        const Vec3 centre = tiles.lattice.centre(tiles.tile[at(t)]);
        Bounds bounds;
        for (Index k = tiles.chunk_start[at(t)]; k < tiles.chunk_start[at(t + 1)]; ++k) {
            const ChunkBox& box = tiles.box[at(k)];
            bounds.add(centre + Vec3(box.low[0], box.low[1], box.low[2]));
            bounds.add(centre + Vec3(box.high[0], box.high[1], box.high[2]));
        }
        return bounds;
    });
}

TileExtent extent_of(const Bounds& bounds)
{
    return {0.5 * (bounds.min + bounds.max), 0.5 * (bounds.max - bounds.min)};
}

} // namespace hyoryu
