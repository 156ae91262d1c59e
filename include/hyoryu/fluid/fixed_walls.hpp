// SPDX-License-Identifier: MIT
// Walls that do not move. Their particles are known as places, sorted into tiles; those of tiles
// that touch a tile with fluid or bodies have rows in the store of the walls, the others have none:
// a dry wall has no columns, no records and no lists. Which rows there are follows from the tiles
// of fluid and bodies alone, not from the history.
#pragma once

#include "hyoryu/core/tiles.hpp"

namespace hyoryu {

struct FixedWalls {
    // By place, in the order of the numbers.
    std::vector<Vec3> place;          // [m]
    std::vector<double> depth;        // behind the surface [m]; empty where fluid slips
    std::vector<std::int32_t> owner;  // -1 - (index of the wall)
    std::vector<std::int64_t> number; // of the particle, for life; ascending

    std::vector<std::uint64_t> tile;    // that hold places, ascending
    std::vector<std::int32_t> tile_of;  // index of the tile of each place
    std::vector<std::uint8_t> has_rows; // by tile

    Index moving_rows =
        0; // of the store, before those of fixed walls: particles of walls that move

    // Memory of `update_rows`, kept from one time to the next.
    std::vector<std::uint8_t> near;         // by tile
    std::vector<std::int32_t> row_of_place; // -1 where it has none
    std::vector<std::int32_t> old_row;      // by new row; -1 for one that is new
    std::vector<std::int32_t> place_of_row; // by row of fixed walls

    Index size() const { return static_cast<Index>(place.size()); }
    std::size_t bytes() const;
};

/// Sorts the places into tiles; none has rows.
void sort_into_tiles(FixedWalls& walls, const TileLattice& lattice);

/// Gives rows to the places of the tiles that touch one of `wet`, in the order of their numbers,
/// and takes those of all others. Rows that stay keep their values, new ones are zero but for
/// position, number, owner and depth. Returns whether anything changed. `room` as in Store::gather.
bool update_rows(FixedWalls& walls, const TileLattice& lattice, std::span<const Tiles* const> wet,
                 Store& store, std::span<std::byte> room);

} // namespace hyoryu
