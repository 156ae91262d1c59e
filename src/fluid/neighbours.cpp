// SPDX-License-Identifier: MIT
// When the lists of the fluid are made, and from what.
#include "hyoryu/fluid/fluid.hpp"
#include "hyoryu/fluid/sum_units.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

namespace hyoryu {

namespace {

const Vec3 everywhere_low = Vec3::Constant(-infinity);
const Vec3 everywhere_high = Vec3::Constant(infinity);

auto at(Index row)
{
    return static_cast<std::size_t>(row);
}

// An edge of a tile over the support: about a hundred particles in a tile, in the plane as in
// space. A skin may be as much as the edge is longer.
real tile_ratio(int dimensions)
{
    return dimensions == 2 ? 2.5 : 2.0;
}

// The tiles of walls against which others are measured. Fixed walls that do not exist yet count:
// the fluid that comes to them is what makes them.
const Tiles& measured_walls(const Fluid& fluid)
{
    return fluid.moving_walls ? fluid.neighbours.wall : fluid.fixed_walls.candidates;
}

// Bounds of how far particles of walls have moved.
void measure_walls(Fluid& fluid)
{
    FluidNeighbours& n = fluid.neighbours;
    if (fluid.moving_walls) {
        bound_motion(n.wall, fluid.particles.wall[field::position], n.wall_motion.box);
    } else {
        n.wall_motion.box.assign(measured_walls(fluid).tile.size(), {Vec3(0, 0, 0), Vec3(0, 0, 0)});
    }
}

// The farthest that particles of tiles beside fixed walls have moved, besides walls that move: the
// tiles of walls that do not exist yet are in no list of tiles that touch.
real motion_beside_fixed_walls(const Fluid& fluid)
{
    const FluidNeighbours& n = fluid.neighbours;
    const Tiles& walls = fluid.fixed_walls.candidates;
    real most = 0;
    const auto look = [&](const Tiles& tiles, const std::vector<DisplacementBox>& boxes) {
        for (std::size_t t = 0; t < tiles.tile.size(); ++t) {
            const real way = boxes[t].low.cwiseAbs().cwiseMax(boxes[t].high.cwiseAbs()).norm();
            const auto place = TileLattice::place_of(tiles.tile[t]);
            for (int k = 0; k < 27 && way > most; ++k) {
                const std::array<int, 3> to{k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
                most = walls.find(tiles.lattice.beside(place, to)) >= 0 ? way : most;
            }
        }
    };
    look(n.fluid, n.fluid_motion.box);
    look(n.body, n.body_motion.box);
    return most;
}

Displacement measure(Fluid& fluid)
{
    FluidNeighbours& n = fluid.neighbours;
    const Particles& particles = fluid.particles;
    DisplacementSpace& f = n.fluid_motion;
    DisplacementSpace& w = n.wall_motion;
    DisplacementSpace& b = n.body_motion;
    Displacement motion;
    motion.absolute = bound_motion(n.fluid, particles.fluid[field::position], f.box);
    motion.absolute =
        std::max(motion.absolute, bound_motion(n.body, particles.body[field::position], b.box));
    if (fluid.moving_walls || n.steps == 1) { // fixed walls stay where they are
        measure_walls(fluid);
        for (const DisplacementBox& box : w.box) {
            motion.absolute =
                std::max(motion.absolute, box.low.cwiseAbs().cwiseMax(box.high.cwiseAbs()).norm());
        }
    }
    motion.fluid = relative_motion(f.box, f.box, f.fluid);
    motion.solid =
        std::max({relative_motion(f.box, w.box, f.wall), relative_motion(f.box, b.box, f.body),
                  relative_motion(b.box, w.box, b.wall), relative_motion(b.box, b.box, b.body)});
    if (fluid.moving_walls) {
        motion.solid = std::max(motion.solid, motion_beside_fixed_walls(fluid));
    }
    return motion;
}

// Whether a pair that is not listed may have come within the support: one of tiles that touch, by
// its relative displacement; any other, by what lies between tiles that do not.
bool stale(const Fluid& fluid, const Displacement& motion)
{
    const FluidNeighbours& n = fluid.neighbours;
    const real between = n.fluid.lattice.edge.minCoeff() - fluid.kernel.support;
    return motion.fluid > n.skins.fluid || motion.solid > n.skins.solid ||
           2 * motion.absolute > between;
}

// Adds up the particles that left the domain, which are in no order.
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
        sum_of_each<4>(count, {of_v, of_v, of_v, units.energy}, [&](Index k) {
            const Vec3& vi = v[rows[at(k)]];
            const real e = 0.5 * vi.squaredNorm() - fluid.parameters.gravity.dot(x[rows[at(k)]]);
            return std::array{vi.x(), vi.y(), vi.z(), e};
        });
    fluid.lost.count += count;
    fluid.lost.momentum += m * Vec3(vx, vy, vz);
    fluid.lost.energy += m * energy;
    if (store.has(field::viscous_force)) {
        const auto F = store[field::viscous_force];
        fluid.lost.force += sum_of_vectors(count, units.force,
                                           [&](Index k) -> const Vec3& { return F[rows[at(k)]]; });
    }
}

// Whether a row behind this one, of the same cell, is at the same place.
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

// No direction leads from one particle at a place to another, so that no force would ever part
// them. They are set on a ring about it, by their numbers; its radius is small enough to change
// nothing else. `key`: the cells of the rows, which are in their order.
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
}

// Puts the tiles of a kind of solids in order; their rows stay.
void sort_solids(Fluid& fluid, Store& store, Tiles& tiles)
{
    const TileLattice lattice = lattice_of(fluid);
    const auto x = store[field::position];
    if (fluid.moving_walls && fluid.period != Vec3(0, 0, 0)) {
        parallel_for(0, store.size(), [&](Index i) { x[i] = lattice.wrapped(x[i]); });
    }
    SortSpace& space = fluid.neighbours.space;
    sort_rows(lattice, {x, store.id()}, everywhere_low, everywhere_high, space);
    make_tiles(tiles, lattice, x, space, store.size());
}

// Makes the fixed walls that lists may know, and drops the others.
void update_fixed_walls(Fluid& fluid)
{
    // Friction acts half a step after lists are made: a particle that fluid leaves within that time
    // has felt none if this is its way at most.
    constexpr real way_of_half_step = 0.1; // spacings
    FluidNeighbours& n = fluid.neighbours;
    const Waters waters{n.fluid, n.body,
                        fluid.kernel.support + n.skins.solid +
                            way_of_half_step * fluid.parameters.spacing};
    const auto room = std::visit([](auto& data) { return data.common.room(); }, fluid.pair_data);
    const bool changed = update_rows(fluid.fixed_walls, waters, fluid.particles.wall, room);
    if (changed && !fluid.moving_walls) { // those that move are sorted with all lists
        make_tiles(fluid.fixed_walls, n.wall);
        n.wall.first_slot = 0;
    }
}

void sort_particles(Fluid& fluid)
{
    Particles& particles = fluid.particles;
    FluidNeighbours& n = fluid.neighbours;
    sort_fluid(fluid);
    sort_solids(fluid, particles.body, n.body);
    update_fixed_walls(fluid);
    if (fluid.moving_walls ||
        n.wall.count() != particles.wall.size()) { // others stay where they are
        sort_solids(fluid, particles.wall, n.wall);
    }
}

// Which tiles touch, and which tiles of walls matter.
void connect(Fluid& fluid)
{
    FluidNeighbours& n = fluid.neighbours;
    find_touching(n.fluid, n.fluid, n.fluid_motion.fluid);
    find_touching(n.fluid, measured_walls(fluid), n.fluid_motion.wall);
    find_touching(n.fluid, n.body, n.fluid_motion.body);
    find_touching(n.body, measured_walls(fluid), n.body_motion.wall);
    find_touching(n.body, n.body, n.body_motion.body);
    n.wet_walls.clear();
    std::vector<std::uint8_t>& wet = n.met;
    wet.assign(n.wall.tile.size(), 0);
    for (const PairList* list : {&n.wall_fluid, &n.wall_body}) {
        for (const ListBlock& block : list->blocks()) {
            const auto after = std::upper_bound(n.wall.start.begin(), n.wall.start.end(),
                                                block.first - n.wall.first_slot);
            wet[at(after - n.wall.start.begin() - 1)] = 1;
        }
    }
    for (std::size_t tile = 0; tile < wet.size(); ++tile) {
        if (wet[tile] != 0) {
            n.wet_walls.push_back(static_cast<std::int32_t>(tile));
        }
    }
}

// What solid particles are that no fluid is near: without pressure and force. The steps look after
// the others.
void dry(Fluid& fluid)
{
    for_solids(fluid.particles, [&](Store& store) {
        clear(store, Fields<Pressure, Force, ShepardSum>{});
        const auto rho = store[field::density];
        const auto V = store[field::volume];
        const auto owner = store.owner();
        parallel_for(0, store.size(), [&](Index i) {
            rho[i] = fluid.parameters.eos.rho0;
            V[i] = stand_in_mass(fluid, owner[i]) / rho[i];
        });
    });
}

// The owners of solid particles, by slot from the first wall slot on.
void collect_owners(const Particles& particles, FluidNeighbours& n)
{
    n.owner.clear();
    const auto append = [&](const Tiles& tiles, const Store& store) {
        for (const std::int32_t row : tiles.row) {
            n.owner.push_back(store.owner()[row]);
        }
    };
    append(n.wall, particles.wall);
    append(n.body, particles.body);
}

int pack_lanes(const Fluid& fluid)
{
    return std::visit(
        [&]<class Real>(const PairData<Real>&) {
            return std::get<PairLoops<Real>>(fluid_loops(fluid.instruction_set)).lanes;
        },
        fluid.pair_data);
}

void clear_lists(std::initializer_list<PairList*> lists)
{
    for (PairList* list : lists) {
        list->clear();
    }
}

void build_lists(Fluid& fluid)
{
    const Particles& particles = fluid.particles;
    FluidNeighbours& n = fluid.neighbours;
    n.fluid.first_slot = 0;
    n.wall.first_slot = n.fluid.count();
    n.body.first_slot = n.wall.first_slot + n.wall.count();
    const PairList::Settings of_pairs{fluid.kernel.support + n.skins.fluid, pack_lanes(fluid),
                                      fluid.instruction_set};
    PairList::Settings settings = of_pairs;
    settings.radius = fluid.kernel.support + n.skins.solid;
    const Tiles* const of_fluid[] = {&n.fluid};
    const Tiles* const of_bodies[] = {&n.body};
    const Tiles* const of_solids[] = {&n.wall, &n.body};
    n.fluid_fluid.build(n.fluid, of_fluid, of_pairs);
    if (has_solids(fluid)) {
        n.fluid_solid.build(n.fluid, of_solids, settings);
        // Dry walls have met nothing and get no lists of their own.
        n.met.assign(at(particles.size()), 0);
        n.fluid_solid.mark_met(n.met);
        n.wall_fluid.build(n.wall, of_fluid, settings, {.wanted = n.met});
        n.body_fluid.build(n.body, of_fluid, settings, {.wanted = n.met});
    } else { // the last body may have left
        clear_lists({&n.fluid_solid, &n.wall_fluid, &n.body_fluid});
    }
    if (particles.body.size() > 0) {
        collect_owners(particles, n);
        n.body_solid.build(n.body, of_solids, settings,
                           {.owner = n.owner, .first_owner = n.wall.first_slot});
        n.met.assign(at(particles.size()), 0);
        n.body_solid.mark_met(n.met);
        n.wall_body.build(n.wall, of_bodies, settings, {.wanted = n.met});
    } else {
        clear_lists({&n.body_solid, &n.wall_body});
    }
    connect(fluid);
    std::visit([&](auto& data) { data.slots = fluid.particles.size(); }, fluid.pair_data);
    const Index of_fluid_alone = n.fluid_fluid.entries();
    const Index with_solids =
        n.fluid_solid.entries() + n.wall_fluid.entries() + n.body_fluid.entries();
    const Index films = n.body_solid.entries() + n.wall_body.entries();
    n.entries = {of_fluid_alone, with_solids + films};
    // Pressure and velocity loops of the fluid; extrapolation and loads of the solids; films.
    n.visits = 2 * (of_fluid_alone + with_solids) + films;
    std::visit([&](auto& data) { data.records().load(particles.wall, n.wall, Stored{}); },
               fluid.pair_data);
}

} // namespace

TileLattice lattice_of(const Fluid& fluid)
{
    const Vec3 origin = fluid.domain_min.allFinite() ? fluid.domain_min : Vec3(Vec3::Zero());
    return make_lattice(origin, tile_ratio(fluid.parameters.dimensions) * fluid.kernel.support,
                        fluid.period);
}

void place_fixed_walls(Fluid& fluid)
{
    for (Tiles* tiles : {&fluid.neighbours.fluid, &fluid.neighbours.body}) {
        tiles->lattice = lattice_of(fluid);
        bound_chunks(*tiles);
    }
    update_fixed_walls(fluid);
}

void update_neighbours(Fluid& fluid)
{
    if (lists_are_due(fluid, false)) {
        make_lists(fluid);
    }
}

bool lists_are_due(Fluid& fluid, bool asked)
{
    FluidNeighbours& n = fluid.neighbours;
    n.steps += 1;
    if (n.builds == 0) {
        n.skins = n.skins.fluid > 0 ? n.skins : first_skins(fluid.parameters.spacing);
        return true;
    }
    const Displacement motion = measure(fluid);
    if (!asked && !stale(fluid, motion)) {
        return false;
    }
    n.skins = best_skins(motion, n.steps, n.entries, n.skins, fluid.kernel.support,
                         fluid.parameters.spacing);
    return true;
}

void make_lists(Fluid& fluid)
{
    FluidNeighbours& n = fluid.neighbours;
    sort_particles(fluid);
    build_lists(fluid);
    dry(fluid);
    n.builds += 1;
    n.steps = 0;
}

void rebuild_neighbours(Fluid& fluid)
{
    for (Tiles* tiles : {&fluid.neighbours.fluid, &fluid.neighbours.wall, &fluid.neighbours.body}) {
        tiles->lattice = lattice_of(fluid);
        bound_chunks(*tiles);
    }
    build_lists(fluid);
    dry(fluid); // a store that was just made holds the pressures of time 0
    if (!fluid.moving_walls) {
        measure_walls(fluid);
    }
}

} // namespace hyoryu
