// SPDX-License-Identifier: MIT
#include "own_particles.hpp"

#include "hyoryu/core/motion.hpp"
#include "hyoryu/fluid/whole.hpp"

namespace hyoryu {

namespace {

std::size_t at(Index k)
{
    return static_cast<std::size_t>(k);
}

void put_walls(Parcel& parcel, const FixedWalls& walls)
{
    put(parcel, walls.first_number);
    put(parcel, walls.count);
    put(parcel, walls.moving_rows);
    put_list(parcel, walls.tile);
    put_list(parcel, walls.start);
    put_list(parcel, walls.run);
}

FixedWalls take_walls(Unpacking& from)
{
    FixedWalls walls;
    walls.first_number = from.take<std::int64_t>();
    walls.count = from.take<Index>();
    walls.moving_rows = from.take<Index>();
    walls.tile = take_list<std::uint64_t>(from);
    walls.start = take_list<std::int32_t>(from);
    walls.run = take_list<IndexRun>(from);
    return walls;
}

void put_moving_walls(Parcel& parcel, const Scene& scene, const Filling& filling)
{
    std::vector<std::int64_t> number;
    std::vector<Vec3> place;
    std::vector<std::int32_t> owner;
    std::vector<double> depth;
    for (std::size_t k = 0; k < filling.wall.size(); ++k) {
        if (is_moving(scene, filling.wall_owner[k])) {
            number.push_back(static_cast<std::int64_t>(k));
            place.push_back(filling.wall[k]);
            owner.push_back(filling.wall_owner[k]);
            if (!filling.wall_depth.empty()) {
                depth.push_back(filling.wall_depth[k]);
            }
        }
    }
    put_list(parcel, number);
    put_list(parcel, place);
    put_list(parcel, owner);
    put_list(parcel, depth);
}

void take_moving_walls(Unpacking& from, Share& share)
{
    share.numbers.wall = take_list<std::int64_t>(from);
    share.filling.wall = take_list<Vec3>(from);
    share.filling.wall_owner = take_list<std::int32_t>(from);
    share.filling.wall_depth = take_list<double>(from);
}

void put_bodies(Parcel& parcel, const std::vector<Aggregate>& bodies)
{
    put(parcel, bodies.size());
    for (const Aggregate& body : bodies) {
        put_list(parcel, body.points);
        put(parcel, body.particle_volume);
        put(parcel, body.surface_points);
        put(parcel, body.cell);
    }
}

std::vector<Aggregate> take_bodies(Unpacking& from)
{
    std::vector<Aggregate> bodies(from.take<std::size_t>());
    for (Aggregate& body : bodies) {
        body.points = take_list<Vec3>(from);
        body.particle_volume = from.take<double>();
        body.surface_points = from.take<Index>();
        body.cell = from.take<Vec3>();
    }
    return bodies;
}

// What all ranks get.
void put_common(Parcel& parcel, const Scene& scene, const Filling& filling, const Share& all)
{
    put_list(parcel, all.cuts.first);
    put_walls(parcel, all.walls);
    put_list(parcel, filling.wall_runs);
    put_list(parcel, filling.wall_shifts);
    put_moving_walls(parcel, scene, filling);
    put_bodies(parcel, filling.bodies);
    put(parcel, filling.domain.min);
    put(parcel, filling.domain.max);
}

void take_common(Unpacking& from, Share& share)
{
    share.cuts.first = take_list<std::uint64_t>(from);
    share.walls = take_walls(from);
    share.filling.wall_runs = take_list<WallRun>(from);
    share.filling.wall_shifts = take_list<Vec3>(from);
    take_moving_walls(from, share);
    share.filling.bodies = take_bodies(from);
    share.filling.domain.min = from.take<Vec3>();
    share.filling.domain.max = from.take<Vec3>();
}

template <class T>
void put_some(Parcel& parcel, const std::vector<T>& values, const std::vector<std::int64_t>& which)
{
    std::vector<T> some;
    if (!values.empty()) { // else nothing has them
        some.reserve(which.size());
        for (const std::int64_t k : which) {
            some.push_back(values[at(k)]);
        }
    }
    put_list(parcel, some);
}

void put_fluid(Parcel& parcel, const Filling& filling, const std::vector<std::int64_t>& which)
{
    put_list(parcel, which);
    put_some(parcel, filling.fluid, which);
    put_some(parcel, filling.fluid_velocity, which);
    put_some(parcel, filling.fluid_depth, which);
    put_some(parcel, filling.fluid_pressure, which);
}

void take_fluid(Unpacking& from, Share& share)
{
    share.numbers.fluid = take_list<std::int64_t>(from);
    share.filling.fluid = take_list<Vec3>(from);
    share.filling.fluid_velocity = take_list<Vec3>(from);
    share.filling.fluid_depth = take_list<double>(from);
    share.filling.fluid_pressure = take_list<double>(from);
}

// What rank 0 deals out.
struct Deck {
    Parcel common;
    std::vector<std::vector<std::int64_t>> fluid; // numbers of particles, by rank
};

Deck make_deck(const Scene& scene, const Filling& filling, const TileLattice* lattice, int ranks)
{
    Deck deck;
    deck.fluid.resize(at(ranks));
    Share all;
    if (lattice != nullptr) {
        all.walls = find_fixed_walls(scene, filling, *lattice);
        all.cuts = even_cuts(*lattice, filling.fluid, ranks);
        for (std::size_t k = 0; k < filling.fluid.size(); ++k) {
            const std::uint64_t tile = lattice->tile_of(lattice->wrapped(filling.fluid[k]));
            deck.fluid[at(all.cuts.owner(tile))].push_back(static_cast<std::int64_t>(k));
        }
    }
    put_common(deck.common, scene, filling, all);
    return deck;
}

} // namespace

bool is_moving(const Scene& scene, std::int32_t wall)
{
    return moves(scene.walls[at(wall)].motion);
}

FixedWalls find_fixed_walls(const Scene& scene, const Filling& filling, const TileLattice& lattice)
{
    FixedWalls walls;
    std::vector<std::int32_t> index;
    std::vector<Vec3> place;
    for (std::size_t k = 0; k < filling.wall.size(); ++k) {
        if (is_moving(scene, filling.wall_owner[k])) {
            ++walls.moving_rows;
            continue;
        }
        index.push_back(static_cast<std::int32_t>(k));
        place.push_back(filling.wall[k]);
    }
    walls.first_number = static_cast<std::int64_t>(filling.fluid.size());
    walls.count = static_cast<Index>(index.size());
    if (walls.count > 0) {
        sort_into_tiles(walls, lattice, index, place);
    }
    return walls;
}

Share deal_out(const Scene& scene, const Filling& filling, const TileLattice* lattice, Comm& comm)
{
    const bool is_root = comm.rank() == 0;
    const Deck deck = is_root ? make_deck(scene, filling, lattice, comm.size()) : Deck{};
    Share own;
    for (int rank = 0; rank < comm.size(); ++rank) {
        std::vector<Parcel> out(at(comm.size()));
        if (is_root) {
            out[at(rank)] = deck.common;
            put_fluid(out[at(rank)], filling, deck.fluid[at(rank)]);
        }
        const std::vector<Parcel> in = comm.exchange(std::move(out));
        if (rank == comm.rank()) {
            Unpacking from(in.front());
            take_common(from, own);
            take_fluid(from, own);
        }
    }
    return own;
}

} // namespace hyoryu
