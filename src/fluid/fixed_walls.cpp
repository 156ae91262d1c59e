// SPDX-License-Identifier: MIT
#include "hyoryu/fluid/fixed_walls.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

std::size_t at(Index k)
{
    return static_cast<std::size_t>(k);
}

// Finds the tiles of the walls that touch a tile with particles of any of `wet`.
void find_near(FixedWalls& walls, const TileLattice& lattice, std::span<const Tiles* const> wet)
{
    const auto holds_any = [&](std::uint64_t tile) {
        return std::ranges::any_of(wet, [&](const Tiles* t) { return t->find(tile) >= 0; });
    };
    std::vector<std::uint8_t>& near = walls.near;
    near.assign(walls.tile.size(), 0);
    parallel_blocks(0, static_cast<Index>(walls.tile.size()), [&](Index t) {
        const auto place = TileLattice::place_of(walls.tile[at(t)]);
        for (int way = 0; way < 27 && near[at(t)] == 0; ++way) {
            const std::array<int, 3> to{way % 3 - 1, way / 3 % 3 - 1, way / 9 - 1};
            near[at(t)] = holds_any(lattice.beside(place, to)) ? 1 : 0;
        }
    });
}

void find_rows_of_places(FixedWalls& walls, const Store& store)
{
    std::vector<std::int32_t>& row = walls.row_of_place;
    row.assign(walls.place.size(), -1);
    const auto id = store.id();
    parallel_for(walls.moving_rows, store.size(), [&](Index k) {
        const auto found = std::ranges::lower_bound(walls.number, id[k]);
        row[at(found - walls.number.begin())] = static_cast<std::int32_t>(k);
    });
}

// The rows to be, from the tiles that are near: those of walls that move, then places by number.
void list_rows(FixedWalls& walls)
{
    walls.old_row.clear();
    walls.place_of_row.clear();
    for (Index row = 0; row < walls.moving_rows; ++row) {
        walls.old_row.push_back(static_cast<std::int32_t>(row));
    }
    for (Index k = 0; k < walls.size(); ++k) {
        if (walls.has_rows[at(walls.tile_of[at(k)])] != 0) {
            walls.old_row.push_back(walls.row_of_place[at(k)]);
            walls.place_of_row.push_back(static_cast<std::int32_t>(k));
        }
    }
}

} // namespace

std::size_t FixedWalls::bytes() const
{
    const auto held = [](const auto& values) { return values.capacity() * sizeof(values[0]); };
    return held(place) + held(depth) + held(owner) + held(number) + held(tile) + held(tile_of) +
           held(has_rows) + held(near) + held(row_of_place) + held(old_row) + held(place_of_row);
}

void sort_into_tiles(FixedWalls& walls, const TileLattice& lattice)
{
    std::vector<std::uint64_t> tile_at(walls.place.size());
    parallel_for(0, walls.size(),
                 [&](Index k) { tile_at[at(k)] = lattice.tile_of(walls.place[at(k)]); });
    walls.tile = tile_at;
    std::ranges::sort(walls.tile);
    const auto repeated = std::ranges::unique(walls.tile);
    walls.tile.erase(repeated.begin(), repeated.end());
    walls.tile.shrink_to_fit();
    walls.tile_of.resize(walls.place.size());
    parallel_for(0, walls.size(), [&](Index k) {
        const auto found = std::ranges::lower_bound(walls.tile, tile_at[at(k)]);
        walls.tile_of[at(k)] = static_cast<std::int32_t>(found - walls.tile.begin());
    });
    walls.has_rows.assign(walls.tile.size(), 0);
}

bool update_rows(FixedWalls& walls, const TileLattice& lattice, std::span<const Tiles* const> wet,
                 Store& store, std::span<std::byte> room)
{
    find_near(walls, lattice, wet);
    if (walls.near == walls.has_rows) {
        return false;
    }
    walls.has_rows.swap(walls.near);
    find_rows_of_places(walls, store);
    list_rows(walls);
    store.gather(walls.old_row, room);
    const auto x = store[field::position];
    parallel_for(0, static_cast<Index>(walls.place_of_row.size()), [&](Index k) {
        const Index row = walls.moving_rows + k;
        const auto place = at(walls.place_of_row[at(k)]);
        x[row] = walls.place[place];
        store.id()[row] = walls.number[place];
        store.owner()[row] = walls.owner[place];
        if (store.has(field::depth)) {
            store[field::depth][row] = walls.depth[place];
        }
    });
    return true;
}

} // namespace hyoryu
