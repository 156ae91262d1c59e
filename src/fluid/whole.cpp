// SPDX-License-Identifier: MIT
#include "hyoryu/fluid/whole.hpp"

#include "hyoryu/ranks/rows.hpp"

#include "sweeps.hpp"

#include <map>
#include <numeric>

namespace hyoryu {

namespace {

// Where the rows of a rank are in the store of one process.
using RowMap = std::vector<std::int32_t>;

// Appends what one rank has of a kind of particles: their rows and their tiles.
void take_kind(Unpacking& from, const RowMap& rows, Store& store, Tiles& tiles)
{
    take_rows(from, store, rows);
    append_tiles(from, rows, tiles);
}

void put_kind(Parcel& parcel, const Tiles& tiles, const Store& store)
{
    put_list(parcel, std::span(tiles.row));
    put_rows(parcel, store, tiles.row);
    put_tiles(parcel, tiles);
}

// Rows of the stores of a rank.
struct Counts {
    Index fluid = 0, wall = 0;
};

// Rows of fixed walls follow those of walls that move, rank after rank.
void shift_fixed(RowMap& rows, Index moving, Index shift)
{
    for (std::int32_t& row : rows) {
        row += row >= moving ? static_cast<std::int32_t>(shift) : 0;
    }
}

WholeFluid room_for(const Fluid& fluid, const std::vector<Counts>& ranks)
{
    const Index moving = fluid.fixed_walls.moving_rows;
    Counts all{.wall = moving};
    for (const Counts& of_rank : ranks) {
        all.fluid += of_rank.fluid;
        all.wall += of_rank.wall - moving;
    }
    WholeFluid whole;
    whole.particles.fluid.reset_like(fluid.particles.fluid, all.fluid);
    whole.particles.wall.reset_like(fluid.particles.wall, all.wall);
    whole.particles.body = fluid.particles.body;
    for (Tiles* const tiles : {&whole.fluid, &whole.wall, &whole.body}) {
        tiles->lattice = fluid.neighbours.fluid.lattice;
    }
    return whole;
}

// Appends what a rank has; `before`: the rows of the ranks before it.
void append(Unpacking from, const Counts& before, Index moving, WholeFluid& whole)
{
    RowMap rows = take_list<std::int32_t>(from);
    for (std::int32_t& row : rows) {
        row += static_cast<std::int32_t>(before.fluid);
    }
    take_kind(from, rows, whole.particles.fluid, whole.fluid);
    rows = take_list<std::int32_t>(from);
    shift_fixed(rows, moving, before.wall);
    take_kind(from, rows, whole.particles.wall, whole.wall);
    rows = take_list<std::int32_t>(from);
    take_kind(from, rows, whole.particles.body, whole.body);
}

Parcel packed(const Fluid& fluid)
{
    const FluidNeighbours& n = fluid.neighbours;
    const Particles& p = fluid.particles;
    Parcel parcel;
    put_kind(parcel, n.fluid, p.fluid);
    put_kind(parcel, n.wall, p.wall);
    put_kind(parcel, n.body, p.body);
    return parcel;
}

} // namespace

WholeFluid gather_whole(const Fluid& fluid)
{
    Comm& comm = fluid.ghosts->comm;
    const Particles& p = fluid.particles;
    const Index moving = fluid.fixed_walls.moving_rows;
    const Counts own{p.fluid.size(), p.wall.size()};
    const std::vector<Counts> ranks = gather(comm, std::span<const Counts>(&own, 1)).all;
    const bool is_root = comm.rank() == 0;
    WholeFluid whole = is_root ? room_for(fluid, ranks) : WholeFluid{};
    Counts before;
    for (int rank = 0; rank < comm.size(); ++rank) { // one at a time, for want of memory
        std::vector<Parcel> out(at(comm.size()));
        if (rank == comm.rank()) {
            out.front() = packed(fluid);
        }
        const std::vector<Parcel> in = comm.exchange(std::move(out));
        if (is_root) {
            append(Unpacking(in[at(rank)]), before, moving, whole);
            before.fluid += ranks[at(rank)].fluid;
            before.wall += ranks[at(rank)].wall - moving;
        }
    }
    for (Tiles* const tiles : {&whole.fluid, &whole.wall, &whole.body}) {
        bound_chunks(*tiles);
    }
    return whole;
}

void swap_parts(Fluid& fluid, WholeFluid& whole, std::unique_ptr<Ghosts>& ghosts)
{
    std::swap(fluid.particles, whole.particles);
    std::swap(fluid.neighbours.fluid, whole.fluid);
    std::swap(fluid.neighbours.wall, whole.wall);
    std::swap(fluid.neighbours.body, whole.body);
    std::swap(fluid.ghosts, ghosts);
}

Cuts even_cuts(const TileLattice& lattice, std::span<const Vec3> fluid, int ranks)
{
    std::map<std::uint64_t, double> count;
    for (const Vec3& x : fluid) {
        count[lattice.tile_of(lattice.wrapped(x))] += 1;
    }
    std::vector<std::uint64_t> tiles;
    std::vector<double> weights;
    for (const auto& [tile, particles] : count) {
        tiles.push_back(tile);
        weights.push_back(particles);
    }
    return cut_evenly(tiles, weights, ranks);
}

void keep_tiles(Tiles& tiles, const TileRange& own)
{
    Tiles kept{.lattice = tiles.lattice};
    const std::array<std::vector<float> Tiles::*, 3> columns{&Tiles::x, &Tiles::y, &Tiles::z};
    for (std::size_t t = 0; t < tiles.tile.size(); ++t) {
        if (!own.holds(tiles.tile[t])) {
            continue;
        }
        const auto copy = [&](const auto& from, auto& to) {
            to.insert(to.end(), from.begin() + tiles.start[t], from.begin() + tiles.start[t + 1]);
        };
        kept.tile.push_back(tiles.tile[t]);
        copy(tiles.row, kept.row);
        for (const auto column : columns) {
            copy(tiles.*column, kept.*column);
        }
        kept.start.push_back(static_cast<std::int32_t>(kept.row.size()));
    }
    bound_chunks(kept);
    tiles = std::move(kept);
}

WallRows wall_rows(const Fluid& fluid)
{
    const Index moving = fluid.fixed_walls.moving_rows;
    const Index own = fluid.particles.wall.size() - moving;
    WallRows rows{.first = moving, .all = moving + own};
    if (fluid.ghosts) {
        Comm& comm = fluid.ghosts->comm;
        const std::vector<Index> each = gather(comm, std::span<const Index>(&own, 1)).all;
        rows.first += std::accumulate(each.begin(), each.begin() + comm.rank(), Index(0));
        rows.all = std::accumulate(each.begin(), each.end(), moving);
    }
    return rows;
}

} // namespace hyoryu
