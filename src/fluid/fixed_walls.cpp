// SPDX-License-Identifier: MIT
// Steps of an update: find the wall tiles that touch a tile of the fluid or of wet bodies; make the
// particles of newly found tiles as candidates; mark the candidates within reach; rebuild the store
// from the remaining and the new rows.
#include "hyoryu/fluid/fixed_walls.hpp"

#include "hyoryu/core/vicinity.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

namespace hyoryu {

namespace {

Index index_of(const std::vector<std::uint64_t>& tiles, std::uint64_t number)
{
    const auto found = std::ranges::lower_bound(tiles, number);
    return found != tiles.end() && *found == number ? found - tiles.begin() : -1;
}

// Marks the tiles of the walls that touch one of `tiles` for which `counts(index)` holds.
void touch(FixedWalls& walls, const Tiles& tiles, const auto& counts)
{
    parallel_blocks(0, tiles.tiles(), [&](Index t) {
        if (!counts(t)) {
            return;
        }
        tiles.lattice.for_beside(tiles.tile[at(t)], [&](std::uint64_t number, const auto&) {
            const Index found = index_of(walls.tile, number);
            if (found >= 0) {
                std::atomic_ref(walls.touched[at(found)]).store(1, std::memory_order_relaxed);
            }
        });
    });
}

// The own tiles whose particles may be within reach, ascending.
void find_near(FixedWalls& walls, std::span<const Waters> waters, const TileRange& own,
               std::vector<std::int32_t>& near)
{
    walls.touched.assign(walls.tile.size(), 0);
    for (const Waters& water : waters) {
        touch(walls, water.tiles, [&](Index t) {
            if (water.counted.empty()) {
                return true;
            }
            const auto first = water.counted.begin() + water.tiles.start[at(t)];
            const auto last = water.counted.begin() + water.tiles.start[at(t + 1)];
            return std::find(first, last, 1) != last;
        });
    }
    near.clear();
    for (std::size_t t = 0; t < walls.touched.size(); ++t) {
        if (walls.touched[t] != 0 && own.holds(walls.tile[t])) {
            near.push_back(static_cast<std::int32_t>(t));
        }
    }
}

Index particles_in(const FixedWalls& walls, std::int32_t tile)
{
    Index count = 0;
    for (std::int32_t k = walls.start[at(tile)]; k < walls.start[at(tile + 1)]; ++k) {
        count += walls.run[at(k)].count;
    }
    return count;
}

// Makes the candidates of a tile, in the order of their cells and indices.
void make_candidates(FixedWalls& walls, std::int32_t tile, Tiles& candidates, Index slot)
{
    std::vector<WallCandidate>& made = walls.made[at(worker())];
    made.clear();
    for (std::int32_t k = walls.start[at(tile)]; k < walls.start[at(tile + 1)]; ++k) {
        const IndexRun run = walls.run[at(k)];
        for (std::int32_t index = run.first; index < run.first + run.count; ++index) {
            const Vec3 place = walls.make(index).place;
            made.push_back({candidates.lattice.cell_of(place), index, place});
        }
    }
    std::ranges::sort(made, {}, [](const WallCandidate& m) { return std::pair(m.cell, m.index); });
    const Vec3 centre = candidates.lattice.centre(walls.tile[at(tile)]);
    for (const WallCandidate& m : made) {
        const Vec3 r = m.place - centre;
        candidates.row[at(slot)] = m.index;
        candidates.x[at(slot)] = static_cast<float>(r.x());
        candidates.y[at(slot)] = static_cast<float>(r.y());
        candidates.z[at(slot)] = static_cast<float>(r.z());
        ++slot;
    }
}

void copy_candidates(const Tiles& from, Index tile, Tiles& to, Index slot)
{
    const Index first = from.start[at(tile)];
    const Index count = from.start[at(tile + 1)] - first;
    std::copy_n(from.row.begin() + first, count, to.row.begin() + slot);
    for (auto column : {&Tiles::x, &Tiles::y, &Tiles::z}) {
        std::copy_n((from.*column).begin() + first, count, (to.*column).begin() + slot);
    }
}

// Collects the candidates of the near tiles; tiles that were near before keep theirs.
void update_candidates(FixedWalls& walls, const TileLattice& lattice,
                       std::span<const std::int32_t> near)
{
    Tiles& next = walls.last_candidates;
    next.lattice = lattice;
    next.tile.clear();
    next.start.assign(1, 0);
    walls.made.resize(std::max(walls.made.size(), at(thread_count())));
    for (const std::int32_t tile : near) {
        next.tile.push_back(walls.tile[at(tile)]);
        next.start.push_back(next.start.back() +
                             static_cast<std::int32_t>(particles_in(walls, tile)));
    }
    next.row.resize(at(next.start.back()));
    for (auto column : {&Tiles::x, &Tiles::y, &Tiles::z}) {
        (next.*column).resize(next.row.size());
    }
    parallel_blocks(0, next.tiles(), [&](Index t) {
        const Index before = index_of(walls.candidates.tile, next.tile[at(t)]);
        if (before >= 0) {
            copy_candidates(walls.candidates, before, next, next.start[at(t)]);
        } else {
            make_candidates(walls, near[at(t)], next, next.start[at(t)]);
        }
    });
    bound_chunks(next);
    std::swap(walls.candidates, walls.last_candidates);
    walls.near.assign(near.begin(), near.end());
}

// The row of each candidate that has one; -1 for the others.
void find_rows(FixedWalls& walls, const Store& store)
{
    const Tiles& candidates = walls.candidates;
    walls.row_of.assign(candidates.row.size(), -1);
    const auto x = store[field::position];
    const auto id = store.id();
    parallel_for(walls.moving_rows, store.size(), [&](Index row) {
        const Index tile = candidates.find(candidates.lattice.tile_of(x[row]));
        if (tile < 0) {
            return;
        }
        const auto index = static_cast<std::int32_t>(id[row] - walls.first_number);
        const auto first = candidates.row.begin() + candidates.start[at(tile)];
        const auto last = candidates.row.begin() + candidates.start[at(tile + 1)];
        const auto found = std::find(first, last, index);
        if (found != last) {
            walls.row_of[at(found - candidates.row.begin())] = static_cast<std::int32_t>(row);
        }
    });
}

// Fills the store with the rows of existing candidates, behind those of moving walls.
void gather_rows(FixedWalls& walls, Store& store, std::span<std::byte> room)
{
    find_rows(walls, store);
    walls.old_row.clear();
    for (Index row = 0; row < walls.moving_rows; ++row) {
        walls.old_row.push_back(static_cast<std::int32_t>(row));
    }
    std::vector<std::int32_t>& made = walls.row_of; // becomes the indices of the rows
    std::size_t rows = 0;
    for (std::size_t k = 0; k < walls.exists.size(); ++k) {
        if (walls.exists[k] != 0) {
            walls.old_row.push_back(walls.row_of[k]);
            made[rows++] = walls.candidates.row[k];
        }
    }
    store.gather(walls.old_row, room);
    const auto x = store[field::position];
    parallel_for(0, static_cast<Index>(rows), [&](Index k) {
        const Index row = walls.moving_rows + k;
        if (walls.old_row[at(row)] >= 0) {
            return;
        }
        const WallPoint point = walls.make(made[at(k)]);
        x[row] = point.place;
        store.id()[row] = walls.first_number + made[at(k)];
        store.owner()[row] = point.owner;
        store[field::displaced_mass][row] = point.displaced_mass;
        if (store.has(field::depth)) {
            store[field::depth][row] = point.depth;
        }
    });
}

} // namespace

void append_run(FixedWalls& walls, std::uint64_t tile, const IndexRun& run)
{
    const bool new_tile = walls.tile.empty() || walls.tile.back() != tile;
    if (new_tile) {
        walls.tile.push_back(tile);
        walls.start.push_back(static_cast<std::int32_t>(walls.run.size()));
    }
    if (new_tile || walls.run.back().first + walls.run.back().count != run.first) {
        walls.run.push_back({run.first, 0});
    }
    walls.run.back().count += run.count;
}

void sort_into_tiles(FixedWalls& walls, const TileLattice& lattice,
                     std::span<const std::int32_t> index, std::span<const Vec3> place)
{
    struct Entry {
        std::uint64_t tile;
        std::int32_t index;
    };
    std::vector<Entry> entries(index.size());
    parallel_for(0, static_cast<Index>(index.size()), [&](Index k) {
        entries[at(k)] = {lattice.tile_of(place[at(k)]), index[at(k)]};
    });
    std::ranges::sort(entries, {}, [](const Entry& e) { return std::pair(e.tile, e.index); });
    walls.tile.clear();
    walls.start.clear();
    walls.run.clear();
    for (const Entry& entry : entries) {
        append_run(walls, entry.tile, {entry.index, 1});
    }
    walls.start.push_back(static_cast<std::int32_t>(walls.run.size()));
    walls.tile.shrink_to_fit();
    walls.start.shrink_to_fit();
    walls.run.shrink_to_fit();
}

bool update_rows(FixedWalls& walls, std::span<const Waters> waters, const WallReach& which,
                 Store& store, std::span<std::byte> room)
{
    find_near(walls, waters, which.own, walls.old_row);
    const bool others = walls.old_row != walls.near;
    if (others) {
        update_candidates(walls, waters.front().tiles.lattice, walls.old_row);
    }
    walls.marks.assign(walls.candidates.row.size(), 0);
    for (const Waters& water : waters) {
        mark_near(walls.candidates, water.tiles, water.counted, which.reach, walls.marks);
    }
    if (!others && walls.marks == walls.exists) {
        return false;
    }
    walls.exists.swap(walls.marks);
    gather_rows(walls, store, room);
    return true;
}

void make_tiles(const FixedWalls& walls, Tiles& tiles)
{
    const Tiles& from = walls.candidates;
    tiles.lattice = from.lattice;
    for (auto column : {&Tiles::x, &Tiles::y, &Tiles::z}) {
        (tiles.*column).clear();
    }
    tiles.tile.clear();
    tiles.start.assign(1, 0);
    tiles.row.clear();
    for (Index t = 0; t < from.tiles(); ++t) {
        for (Index k = from.start[at(t)]; k < from.start[at(t + 1)]; ++k) {
            if (walls.exists[at(k)] != 0) {
                tiles.row.push_back(static_cast<std::int32_t>(tiles.row.size()));
                tiles.x.push_back(from.x[at(k)]);
                tiles.y.push_back(from.y[at(k)]);
                tiles.z.push_back(from.z[at(k)]);
            }
        }
        if (tiles.count() > tiles.start.back()) {
            tiles.tile.push_back(from.tile[at(t)]);
            tiles.start.push_back(static_cast<std::int32_t>(tiles.count()));
        }
    }
    bound_chunks(tiles);
}

} // namespace hyoryu
