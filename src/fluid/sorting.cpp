// SPDX-License-Identifier: MIT
// Sorts the particles by tiles and remakes the ghosts of other ranks before lists are built.
#include "hyoryu/core/vicinity.hpp"
#include "hyoryu/fluid/sum_units.hpp"
#include "hyoryu/fluid/totals.hpp"

#include "lists.hpp"
#include "sharing.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

namespace hyoryu {

namespace {

const Vec3 everywhere_low = Vec3::Constant(-infinity);
const Vec3 everywhere_high = Vec3::Constant(infinity);

// Adds up the particles that left the domain; they are unsorted.
void count_lost(Fluid& fluid, std::span<const std::int32_t> rows)
{
    const Store& store = fluid.particles.fluid;
    const auto x = store[field::position];
    const auto v = store[field::velocity];
    const real m = fluid.parameters.mass;
    const auto count = static_cast<Index>(rows.size());
    const SumUnits units = sum_units(fluid.parameters);
    const FixedUnit of_v = units.velocity;
    const auto [vx, vy, vz, energy] =
        sum_over_ranks<4>(comm_of(fluid), count, {of_v, of_v, of_v, units.energy}, [&](Index k) {
            const Vec3& vi = v[rows[at(k)]];
            const real e = 0.5 * vi.squaredNorm() - fluid.parameters.gravity.dot(x[rows[at(k)]]);
            return std::array{vi.x(), vi.y(), vi.z(), e};
        });
    fluid.lost.count += count_over_ranks(fluid, count);
    fluid.lost.momentum += m * Vec3(vx, vy, vz);
    fluid.lost.energy += m * energy;
    if (store.has(field::viscous_force)) {
        const auto F = store[field::viscous_force];
        fluid.lost.force +=
            vector_sum_over_ranks(comm_of(fluid), count, units.force,
                                  [&](Index k) -> const Vec3& { return F[rows[at(k)]]; });
    }
}

// Whether a later row of the same cell is at the same place.
bool is_met(std::span<const Vec3> x, std::span<const std::uint64_t> key, Index row)
{
    for (std::size_t k = at(row) + 1; k < x.size() && key[k] == key[at(row)]; ++k) {
        if (x[k] == x[at(row)]) {
            return true;
        }
    }
    return false;
}

// Sets rows at one place on a ring about it in x-z, in the order of their numbers [m].
void set_on_ring(Store& store, std::span<std::size_t> ring, real radius)
{
    constexpr real golden_angle = 2.399963229728653; // so that rings of several places differ
    const auto x = store[field::position];
    const auto id = store.id();
    std::ranges::sort(ring, {}, [&](std::size_t k) { return id[k]; });
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const real part = static_cast<real>(k) / static_cast<real>(ring.size());
        const real angle =
            golden_angle * static_cast<real>(id[ring[0]]) + 2 * std::numbers::pi_v<real> * part;
        x[ring[k]] += radius * Vec3(std::cos(angle), 0, std::sin(angle));
    }
}

// Pair forces between coincident particles have no direction and cannot separate them. Such
// particles are placed on a small ring about their place, in the order of their numbers. `key`: the
// cells of the rows, which are in their order.
void part_coincident(Fluid& fluid, std::span<const std::uint64_t> key)
{
    Store& store = fluid.particles.fluid;
    const auto x = store[field::position];
    const auto met = [&](Index row) { return is_met(x, key, row); };
    const auto count = static_cast<Index>(x.size());
    if (!reduce(0, count, false, met, std::logical_or<>{})) {
        return;
    }
    std::vector<std::size_t> ring;
    for (Index row = 0; row < count; ++row) {
        if (!met(row)) {
            continue;
        }
        ring.clear();
        for (std::size_t k = at(row); k < x.size() && key[k] == key[at(row)]; ++k) {
            if (x[k] == x[at(row)]) {
                ring.push_back(k);
            }
        }
        set_on_ring(store, ring, 0.05 * fluid.parameters.spacing);
    }
}

// Puts the fluid rows into the order of the tiles, without those that left the domain.
void sort_fluid(Fluid& fluid)
{
    Store& store = fluid.particles.fluid;
    SortSpace& space = fluid.neighbours.space;
    const TileLattice lattice = lattice_of(fluid);
    if (fluid.period != Vec3(0, 0, 0)) {
        const auto x = store[field::position];
        parallel_for(0, store.size(), [&](Index i) { x[i] = lattice.wrapped(x[i]); });
    }
    migrate_fluid(fluid, lattice);
    const Index kept = sort_rows(lattice, {store[field::position], store.id()}, fluid.domain_min,
                                 fluid.domain_max, space);
    const std::span<const std::int32_t> order = space.row;
    count_lost(fluid, order.subspan(at(kept)));
    // The records are written anew before they are read again.
    std::visit([&](auto& data) { store.gather(order.first(at(kept)), data.common.room()); },
               fluid.pair_data);
    part_coincident(fluid, space.key);
    std::iota(space.row.begin(), space.row.begin() + kept, 0);
    make_tiles(fluid.neighbours.fluid, lattice, store[field::position], space, kept);
    make_ghosts_of_fluid(fluid);
}

// Removes the sorted rows of other ranks' tiles; returns the number of own rows.
Index keep_own(const TileRange& own, SortSpace& space, Index count)
{
    Index kept = 0;
    for (Index k = 0; k < count; ++k) {
        if (own.holds(TileLattice::tile_of_cell(space.key[at(k)]))) {
            space.key[at(kept)] = space.key[at(k)];
            space.row[at(kept)] = space.row[at(k)];
            ++kept;
        }
    }
    return kept;
}

// Puts the own tiles of a kind of solids in order; their rows stay.
void sort_solids(Fluid& fluid, Store& store, Tiles& tiles)
{
    const TileLattice lattice = lattice_of(fluid);
    const auto x = store[field::position];
    if (fluid.moving_walls && fluid.period != Vec3(0, 0, 0)) {
        parallel_for(0, store.size(), [&](Index i) { x[i] = lattice.wrapped(x[i]); });
    }
    SortSpace& space = fluid.neighbours.space;
    Index count = sort_rows(lattice, {x, store.id()}, everywhere_low, everywhere_high, space);
    if (fluid.ghosts) {
        count = keep_own(own_tiles(fluid), space, count);
    }
    make_tiles(tiles, lattice, x, space, count);
}

// Marks the body particles within reach of the fluid, own ones and ghosts.
void mark_wet_bodies(Fluid& fluid, real reach)
{
    FluidNeighbours& n = fluid.neighbours;
    n.wet_body.assign(at(n.body.count()), 0);
    mark_near(n.body, n.fluid, {}, reach, n.wet_body);
    if (fluid.ghosts) {
        Ghosts& g = *fluid.ghosts;
        mark_near(n.body, g.fluid.tiles, {}, reach, n.wet_body);
        g.wet_body.assign(at(g.body.tiles.count()), 0);
        share_marks(g.comm, g.body.halo, n.wet_body, g.wet_body);
    }
}

} // namespace

void update_fixed_walls(Fluid& fluid)
{
    // Friction acts half a step after lists are built. With this extra reach a wall particle that
    // is dropped has felt no friction, provided that fluid moves at most this far in half a step.
    constexpr real way_of_half_step = 0.1; // spacings
    FluidNeighbours& n = fluid.neighbours;
    const WallReach which{fluid.kernel.support + n.skins.solid +
                              way_of_half_step * fluid.parameters.spacing,
                          own_tiles(fluid)};
    mark_wet_bodies(fluid, which.reach);
    const auto room = std::visit([](auto& data) { return data.common.room(); }, fluid.pair_data);
    const auto update = [&](std::span<const Waters> waters) {
        return update_rows(fluid.fixed_walls, waters, which, fluid.particles.wall, room);
    };
    const Waters own[] = {{n.fluid, {}}, {n.body, n.wet_body}};
    bool changed = false;
    if (const Ghosts* const g = fluid.ghosts.get()) {
        const Waters all[] = {own[0], own[1], {g->fluid.tiles, {}}, {g->body.tiles, g->wet_body}};
        changed = update(all);
    } else {
        changed = update(own);
    }
    if (changed && !fluid.moving_walls) { // moving walls are sorted with every rebuild
        make_tiles(fluid.fixed_walls, n.wall);
        n.wall.first_slot = 0;
    }
}

void sort_particles(Fluid& fluid)
{
    Particles& particles = fluid.particles;
    FluidNeighbours& n = fluid.neighbours;
    if (fluid.ghosts && fluid.ghosts->next_cuts) {
        fluid.ghosts->cuts = std::move(*fluid.ghosts->next_cuts);
        fluid.ghosts->next_cuts.reset();
    }
    const FrictionOnTheMove friction(fluid, lattice_of(fluid));
    sort_fluid(fluid);
    sort_solids(fluid, particles.body, n.body);
    make_ghosts_of_bodies(fluid);
    update_fixed_walls(fluid);
    if (fluid.moving_walls ||
        n.wall.count() != particles.wall.size()) { // others stay where they are
        sort_solids(fluid, particles.wall, n.wall);
    }
    friction.arrive(fluid);
    make_ghosts_of_walls(fluid);
}

} // namespace hyoryu
