// SPDX-License-Identifier: MIT
#include "hyoryu/fluid/whole.hpp"

#include "hyoryu/ranks/rows.hpp"

#include "lists.hpp"
#include "sharing.hpp"
#include "sweeps.hpp"

#include <map>
#include <numeric>
#include <unordered_map>

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
    put(parcel, tiles.count());
    put(parcel, std::span(tiles.row));
    put_rows(parcel, store, tiles.row);
    put_tiles(parcel, tiles);
}

RowMap take_row_numbers(Unpacking& from)
{
    RowMap rows(at(from.take<Index>()));
    from.take(std::span(rows));
    return rows;
}

// The rows of all ranks by the first numbers of their parcels.
struct Counts {
    Index fluid = 0, wall = 0, body = 0; // rows of the stores
};

// Rows of fixed walls follow those of walls that move, rank after rank.
void shift_fixed(RowMap& rows, Index moving, Index shift)
{
    for (std::int32_t& row : rows) {
        row += row >= moving ? static_cast<std::int32_t>(shift) : 0;
    }
}

WholeFluid unpacked(const Fluid& fluid, const std::vector<Parcel>& in)
{
    const Index moving = fluid.fixed_walls.moving_rows;
    Counts all{.wall = moving};
    for (const Parcel& parcel : in) {
        const auto of_rank = Unpacking(parcel).take<Counts>();
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
    Counts before;
    for (const Parcel& parcel : in) {
        Unpacking from(parcel);
        const auto of_rank = from.take<Counts>();
        RowMap rows = take_row_numbers(from);
        for (std::int32_t& row : rows) {
            row += static_cast<std::int32_t>(before.fluid);
        }
        take_kind(from, rows, whole.particles.fluid, whole.fluid);
        rows = take_row_numbers(from);
        shift_fixed(rows, moving, before.wall);
        take_kind(from, rows, whole.particles.wall, whole.wall);
        rows = take_row_numbers(from);
        take_kind(from, rows, whole.particles.body, whole.body);
        before.fluid += of_rank.fluid;
        before.wall += of_rank.wall - moving;
    }
    for (Tiles* const tiles : {&whole.fluid, &whole.wall, &whole.body}) {
        bound_chunks(*tiles);
    }
    return whole;
}

// Leaves the tiles of a range.
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

// Leaves the fluid of a range, whose rows are in the order of the tiles.
void keep_fluid(Fluid& fluid, const TileRange& own)
{
    Tiles& tiles = fluid.neighbours.fluid;
    keep_tiles(tiles, own);
    fluid.particles.fluid.gather(tiles.row);
    std::iota(tiles.row.begin(), tiles.row.end(), 0);
}

// Leaves the walls of a range; rows of walls that move stay on all ranks.
void keep_walls(Fluid& fluid, const TileRange& own)
{
    Store& store = fluid.particles.wall;
    Tiles& tiles = fluid.neighbours.wall;
    std::vector<std::int64_t> number; // of each point
    for (const std::int32_t row : tiles.row) {
        number.push_back(store.id()[row]);
    }
    Tiles before = tiles;
    update_fixed_walls(fluid);
    if (!fluid.moving_walls) {
        return; // which made the tiles, too
    }
    std::unordered_map<std::int64_t, std::int32_t> row_of;
    for (Index row = 0; row < store.size(); ++row) {
        row_of[store.id()[row]] = static_cast<std::int32_t>(row);
    }
    for (std::size_t k = 0; k < number.size(); ++k) {
        const auto found = row_of.find(number[k]);
        before.row[k] = found == row_of.end() ? -1 : found->second;
    }
    tiles = std::move(before);
    keep_tiles(tiles, own);
}

} // namespace

WholeFluid gather_whole(const Fluid& fluid)
{
    Comm& comm = fluid.ghosts->comm;
    const FluidNeighbours& n = fluid.neighbours;
    const Particles& p = fluid.particles;
    std::vector<Parcel> out(at(comm.size()));
    Parcel& parcel = out.front();
    put(parcel, Counts{p.fluid.size(), p.wall.size(), p.body.size()});
    put_kind(parcel, n.fluid, p.fluid);
    put_kind(parcel, n.wall, p.wall);
    put_kind(parcel, n.body, p.body);
    const std::vector<Parcel> in = comm.exchange(std::move(out));
    return comm.rank() == 0 ? unpacked(fluid, in) : WholeFluid{};
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

void keep_share(Fluid& fluid, Comm& comm)
{
    FluidNeighbours& n = fluid.neighbours;
    const auto x = std::as_const(fluid.particles.fluid)[field::position];
    share(fluid, comm, even_cuts(n.fluid.lattice, x, comm.size()));
    const TileRange own = own_tiles(fluid);
    keep_fluid(fluid, own);
    keep_tiles(n.body, own);
    make_ghosts_of_fluid(fluid);
    make_ghosts_of_bodies(fluid);
    keep_walls(fluid, own);
    make_ghosts_of_walls(fluid);
    finish_lists(fluid);
}

} // namespace hyoryu
