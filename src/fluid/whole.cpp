// SPDX-License-Identifier: MIT
#include "hyoryu/fluid/whole.hpp"

#include "hyoryu/ranks/rows.hpp"

#include "sweeps.hpp"

#include <numeric>

namespace hyoryu {

Store whole_bodies(const Fluid& fluid)
{
    Comm& comm = fluid.ghosts->comm;
    Store whole = fluid.particles.body;
    const std::vector<std::int32_t>& own = fluid.neighbours.body.row;
    std::vector<Parcel> out(at(comm.size()));
    if (comm.rank() > 0) {
        put_list(out.front(), own);
        put_rows(out.front(), whole, own);
    }
    const std::vector<Parcel> in = comm.exchange(std::move(out));
    for (std::size_t rank = 1; rank < in.size() && comm.rank() == 0; ++rank) {
        Unpacking from(in[rank]);
        const auto rows = take_list<std::int32_t>(from);
        take_rows(from, whole, rows);
    }
    return whole;
}

Cuts even_cuts(const TileLattice& lattice, std::span<const Vec3> fluid, Comm& comm)
{
    std::map<std::uint64_t, double> own;
    for (const Vec3& x : fluid) {
        own[lattice.tile_of(lattice.wrapped(x))] += 1;
    }
    return cut_evenly(comm, own);
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
