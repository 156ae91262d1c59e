// SPDX-License-Identifier: MIT
// When the lists of the fluid are made, and from what.
#include "hyoryu/fluid/fluid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hyoryu {

namespace {

const Vec3 everywhere_low = Vec3::Constant(-infinity);
const Vec3 everywhere_high = Vec3::Constant(infinity);

auto at(Index row)
{
    return static_cast<std::size_t>(row);
}

// An edge of a tile over the radius of the lists: about a hundred particles in a tile, in the plane
// as in space.
real tile_ratio(int dimensions)
{
    return dimensions == 2 ? 3.5 : 1.4;
}

real radius(const Fluid& fluid)
{
    return fluid.kernel.support + fluid.parameters.skin;
}

TileLattice lattice_of(const Fluid& fluid)
{
    const Vec3 origin = fluid.domain_min.allFinite() ? fluid.domain_min : Vec3(Vec3::Zero());
    return make_lattice(origin, tile_ratio(fluid.parameters.dimensions) * radius(fluid));
}

// Farthest that a point of the tiles has gone since they were made.
real displacement(const Fluid& fluid, const Tiles& tiles)
{
    const auto x = fluid.particles[field::position];
    const real squared = reduce(
        0, tiles.tiles(), real(0),
        [&](Index t) {
            const Vec3 centre = tiles.lattice.centre(tiles.tile[at(t)]);
            real most = 0;
            for (Index k = tiles.start[at(t)]; k < tiles.start[at(t + 1)]; ++k) {
                const Vec3 then = centre + Vec3(tiles.x[at(k)], tiles.y[at(k)], tiles.z[at(k)]);
                most = std::max(most, (x[at(tiles.row[at(k)])] - then).squaredNorm());
            }
            return most;
        },
        [](real a, real b) { return std::max(a, b); });
    return std::sqrt(squared);
}

// Two particles close by at most the sum of their displacements.
bool stale(const Fluid& fluid)
{
    const FluidNeighbours& n = fluid.neighbours;
    if (n.builds == 0) {
        return true;
    }
    const real moved_fluid = displacement(fluid, n.fluid);
    const real moved_solid = std::max(displacement(fluid, n.wall), displacement(fluid, n.body));
    return moved_fluid + std::max(moved_fluid, moved_solid) > fluid.parameters.skin ||
           2 * moved_solid > fluid.parameters.skin;
}

// Books the particles that left the domain.
void count_lost(Fluid& fluid, std::span<const std::int32_t> rows)
{
    const auto x = fluid.particles[field::position];
    const auto v = fluid.particles[field::velocity];
    const real m = fluid.parameters.mass;
    for (const std::int32_t i : rows) {
        const Vec3& vi = v[at(i)];
        fluid.lost.count += 1;
        fluid.lost.momentum += m * vi;
        fluid.lost.energy +=
            0.5 * m * vi.squaredNorm() - m * fluid.parameters.gravity.dot(x[at(i)]);
    }
}

// Puts the fluid rows into the order of the tiles, without those that left the domain.
void sort_fluid(Fluid& fluid)
{
    Particles& particles = fluid.particles;
    SortSpace& space = fluid.neighbours.space;
    const TileLattice lattice = lattice_of(fluid);
    const Index kept = sort_rows(lattice, particles[field::position], particles.fluid(),
                                 fluid.domain_min, fluid.domain_max, space);
    const std::span<const std::int32_t> order = space.row;
    count_lost(fluid, order.subspan(at(kept)));
    particles.permute_fluid(order.first(at(kept)));
    std::iota(space.row.begin(), space.row.begin() + kept, 0);
    make_tiles(fluid.neighbours.fluid, lattice, particles[field::position], space, kept);
}

void sort_solids(Fluid& fluid, Rows rows, Tiles& tiles)
{
    const TileLattice lattice = lattice_of(fluid);
    const auto x = fluid.particles[field::position];
    SortSpace& space = fluid.neighbours.space;
    sort_rows(lattice, x, rows, everywhere_low, everywhere_high, space);
    make_tiles(tiles, lattice, x, space, rows.size());
}

void sort_particles(Fluid& fluid)
{
    const Particles& particles = fluid.particles;
    FluidNeighbours& n = fluid.neighbours;
    sort_fluid(fluid);
    const Rows walls = particles.wall();
    if (fluid.moving_walls || n.walls_in_tiles.size() != walls.size()) {
        sort_solids(fluid, walls, n.wall);
    } else if (n.walls_in_tiles.begin != walls.begin) {
        // Fluid particles left the store and the walls moved up.
        const auto up = static_cast<std::int32_t>(n.walls_in_tiles.begin - walls.begin);
        std::for_each(n.wall.row.begin(), n.wall.row.end(), [&](std::int32_t& row) { row -= up; });
    }
    n.walls_in_tiles = walls;
    sort_solids(fluid, particles.body(), n.body);
}

// Room for the records of all slots, and for those that a block looks at, on each thread.
void make_room(Fluid& fluid)
{
    const FluidNeighbours& n = fluid.neighbours;
    std::int32_t chunks = 0;
    for (const PairList* list : {&n.fluid_fluid, &n.fluid_solid, &n.wall_fluid, &n.body_fluid,
                                 &n.body_solid, &n.wall_body}) {
        chunks = std::max(chunks, list->most_chunks());
    }
    std::visit(
        [&](auto& data) {
            data.records.resize(fluid.particles.size());
            data.local.resize(
                std::max(data.local.size(), static_cast<std::size_t>(thread_count())));
            for (auto& room : data.local) {
                room.resize(std::max(room.size(), at(chunk_slots * chunks + 1)));
            }
        },
        fluid.pair_data);
}

int pack_lanes(const Fluid& fluid)
{
    return std::visit(
        [&]<class Real>(const PairData<Real>&) {
            return std::get<PairLoops<Real>>(fluid_loops(fluid.instruction_set)).lanes;
        },
        fluid.pair_data);
}

void build_lists(Fluid& fluid)
{
    const Particles& particles = fluid.particles;
    FluidNeighbours& n = fluid.neighbours;
    n.fluid.first_slot = 0;
    n.wall.first_slot = n.fluid.count();
    n.body.first_slot = n.wall.first_slot + n.wall.count();
    const PairList::Settings settings{radius(fluid), pack_lanes(fluid), fluid.instruction_set};
    const Tiles* const of_fluid[] = {&n.fluid};
    const Tiles* const of_bodies[] = {&n.body};
    const Tiles* const of_solids[] = {&n.wall, &n.body};
    n.fluid_fluid.build(n.fluid, of_fluid, settings);
    if (particles.solid().size() > 0) {
        n.fluid_solid.build(n.fluid, of_solids, settings);
        // Dry walls have met nothing and get no lists of their own.
        n.met.assign(at(particles.size()), 0);
        n.fluid_solid.mark_met(n.met);
        n.wall_fluid.build(n.wall, of_fluid, settings, {.wanted = n.met});
        n.body_fluid.build(n.body, of_fluid, settings, {.wanted = n.met});
    }
    if (particles.body().size() > 0) {
        n.body_solid.build(n.body, of_solids, settings, {.owner = particles.owner()});
        n.met.assign(at(particles.size()), 0);
        n.body_solid.mark_met(n.met);
        n.wall_body.build(n.wall, of_bodies, settings, {.wanted = n.met});
    }
    make_room(fluid);
    n.builds += 1;
    // Pressure and velocity loops of the fluid; extrapolation and loads of the solids; films.
    n.visits = 2 * (n.fluid_fluid.entries() + n.fluid_solid.entries() + n.wall_fluid.entries() +
                    n.body_fluid.entries()) +
               n.body_solid.entries() + n.wall_body.entries();
}

} // namespace

void update_neighbours(Fluid& fluid)
{
    if (!stale(fluid)) {
        return;
    }
    sort_particles(fluid);
    build_lists(fluid);
}

void rebuild_neighbours(Fluid& fluid)
{
    for (Tiles* tiles : {&fluid.neighbours.fluid, &fluid.neighbours.wall, &fluid.neighbours.body}) {
        tiles->lattice = lattice_of(fluid);
        bound_chunks(*tiles);
    }
    build_lists(fluid);
}

} // namespace hyoryu
