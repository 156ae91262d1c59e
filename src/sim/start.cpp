// SPDX-License-Identifier: MIT
// A simulation at time 0.
#include "hyoryu/fluid/whole.hpp"
#include "hyoryu/scene/rigid_scene.hpp"
#include "hyoryu/scene/shapes.hpp"
#include "hyoryu/scene/wall_layers.hpp"

#include "hyoryu/sim/whole.hpp"

#include "parts.hpp"

#include <cmath>
#include <numeric>

namespace hyoryu {

namespace {

std::size_t at(Index row)
{
    return static_cast<std::size_t>(row);
}

// The compressible hydrostatic density at a depth: rho0 exp(g d / c0^2). Starting from rest
// pressure instead would ring for seconds.
double hydrostatic_density(const FluidParameters& f, double depth)
{
    return f.eos.rho0 * std::exp(f.gravity.norm() * depth / sq(f.eos.c0));
}

// The particles of the filling that a process holds: all, or those of its range of tiles.
std::vector<std::size_t> own_particles(const Filling& filling, const Fluid& fluid)
{
    const TileLattice lattice = lattice_of(fluid);
    const TileRange own = own_tiles(fluid);
    std::vector<std::size_t> particles;
    for (std::size_t i = 0; i < filling.fluid.size(); ++i) {
        if (own.holds(lattice.tile_of(lattice.wrapped(filling.fluid[i])))) {
            particles.push_back(i);
        }
    }
    return particles;
}

void fill_fluid_rows(const Filling& filling, std::span<const std::size_t> particles, Fluid& fluid)
{
    Store& store = fluid.particles.fluid;
    const auto x = store[field::position];
    const auto v = store[field::velocity];
    const auto rho = store[field::density];
    for (std::size_t row = 0; row < particles.size(); ++row) {
        const std::size_t i = particles[row];
        store.id()[row] = static_cast<std::int64_t>(i);
        x[row] = filling.fluid[i];
        v[row] = filling.fluid_velocity[i];
        rho[row] = hydrostatic_density(fluid.parameters, filling.fluid_depth[i]) +
                   filling.fluid_pressure[i] / sq(fluid.parameters.eos.c0);
    }
}

// Numbers a store from `first` on.
void number_rows(Store& store, Index first)
{
    std::iota(store.id().begin(), store.id().end(), static_cast<std::int64_t>(first));
}

bool is_moving(const Scene& scene, std::int32_t wall)
{
    return moves(scene.walls[at(wall)].motion);
}

// Walls that do not move: what makes their particles, which exist where water is near.
FixedWalls fixed_walls(const Simulation& sim, const Filling& filling, const Fluid& fluid)
{
    FixedWalls walls;
    std::vector<std::int32_t> index;
    std::vector<Vec3> place;
    for (std::size_t k = 0; k < filling.wall.size(); ++k) {
        if (is_moving(sim.scene, filling.wall_owner[k])) {
            ++walls.moving_rows;
            continue;
        }
        index.push_back(static_cast<std::int32_t>(k));
        place.push_back(filling.wall[k]);
    }
    walls.first_number = static_cast<std::int64_t>(filling.fluid.size());
    walls.count = static_cast<Index>(index.size());
    if (walls.count > 0) {
        sort_into_tiles(walls, lattice_of(fluid), index, place);
        walls.make = wall_maker(sim.scene, filling, sim.barrier->solids);
    }
    return walls;
}

// Walls that move have rows always.
void fill_wall_rows(const Scene& scene, const Filling& filling, Fluid& fluid)
{
    Store& store = fluid.particles.wall;
    Index row = 0;
    for (std::size_t k = 0; k < filling.wall.size(); ++k) {
        const std::int32_t wall = filling.wall_owner[k];
        if (!is_moving(scene, wall)) {
            continue;
        }
        store[field::position][row] = filling.wall[k];
        store[field::velocity][row] = velocity(scene.walls[at(wall)].motion, 0);
        store.owner()[row] = -1 - wall;
        store.id()[row] = static_cast<std::int64_t>(filling.fluid.size() + k);
        if (store.has(field::depth)) {
            store[field::depth][row] = filling.wall_depth[k];
        }
        ++row;
    }
    fluid.moving_walls = row > 0;
}

void fill_body_rows(const Simulation& sim, const Filling& filling, Fluid& fluid)
{
    Store& store = fluid.particles.body;
    number_rows(store, static_cast<Index>(filling.fluid.size() + filling.wall.size()));
    for (std::size_t b = 0; b < filling.bodies.size(); ++b) {
        const Rows rows = sim.body_particles.of[b];
        for (Index k = rows.begin; k < rows.end; ++k) {
            store.owner()[k] = static_cast<std::int32_t>(b);
            if (store.has(field::depth)) {
                const Placed shape{.shape = &sim.scene.bodies[b].shape,
                                   .centre = middle_of_shape(sim.scene.bodies[b]),
                                   .dimensions = sim.scene.dimensions};
                store[field::depth][k] = -signed_distance(shape, sim.body_particles.points[at(k)]);
            }
        }
        fluid.body_particle_mass.push_back(fluid.parameters.eos.rho0 *
                                           filling.bodies[b].particle_volume);
    }
}

Fluid make_fluid(const Simulation& sim, const Filling& filling, Comm* comm)
{
    Fluid fluid;
    fluid.parameters = *sim.plan.fluid;
    fluid.effects = sim.plan.effects;
    fluid.kernel =
        make_kernel(fluid.parameters.h, fluid.parameters.spacing, fluid.parameters.dimensions);
    fluid.mps_kernel = make_mps_kernel(fluid.kernel.support, fluid.parameters.spacing,
                                       fluid.parameters.dimensions);
    // A particle may graze the edge of the domain; two spacings beyond it is gone for good.
    const Vec3 margin = Vec3::Constant(2 * fluid.parameters.spacing);
    fluid.domain_min = filling.domain.min - margin;
    fluid.domain_max = filling.domain.max + margin;
    for (Index axis = 0; axis < 3; ++axis) {
        if (sim.scene.domain && sim.scene.domain->periodic[at(axis)]) {
            fluid.domain_min[axis] = filling.domain.min[axis];
            fluid.period[axis] = filling.domain.max[axis] - filling.domain.min[axis];
        }
    }
    extend_domain(sim.scene, fluid);
    fluid.fixed_walls = fixed_walls(sim, filling, fluid);
    if (comm != nullptr) {
        share(fluid, *comm, even_cuts(lattice_of(fluid), filling.fluid, comm->size()));
    }
    const std::vector<std::size_t> own = own_particles(filling, fluid);
    allocate(fluid, static_cast<Index>(own.size()), fluid.fixed_walls.moving_rows,
             static_cast<Index>(sim.body_particles.points.size()));
    fill_fluid_rows(filling, own, fluid);
    fill_wall_rows(sim.scene, filling, fluid);
    fill_body_rows(sim, filling, fluid);
    return fluid;
}

// A step of a fluid particle costs as much as ten updates of a contact, on one thread.
constexpr double updates_of_particle = 10;

} // namespace

Simulation make_simulation(const Scene& scene, const Plan& plan, const Filling& filling, Comm* comm)
{
    if (comm != nullptr && plan.runs(OpenSides::name)) {
        // The first carpets follow from sums in the order of the filling, which ranks do not have.
        Simulation whole = make_simulation(scene, plan, filling);
        keep_share(whole, *comm);
        update_pressure(*whole.fluid); // of solids, which the first output shows
        return whole;
    }
    Simulation sim{.scene = scene, .plan = plan};
    sim.rigid = make_rigid(scene);
    sim.gauges = make_gauge_memory(scene);
    for (const Aggregate& body : filling.bodies) {
        const auto begin = static_cast<Index>(sim.body_particles.points.size());
        sim.body_particles.points.insert(sim.body_particles.points.end(), body.points.begin(),
                                         body.points.end());
        sim.body_particles.of.push_back(
            {begin, static_cast<Index>(sim.body_particles.points.size())});
    }
    sim.loads.bodies.resize(scene.bodies.size());
    for (const Body& body : sim.rigid.bodies) {
        sim.thinnest = std::min(sim.thinnest, inner_radius(body, scene.dimensions));
    }
    if (plan.fluid) {
        if (plan.runs(SurfaceBarrier::name)) {
            sim.barrier = make_wall_barrier(scene);
        }
        sim.fluid = make_fluid(sim, filling, comm);
        sim.rigid.settings.located_work = scene.contact.locating_share * updates_of_particle *
                                          static_cast<double>(sim.plan.counts.fluid);
        const auto of_walls = sim.fluid->particles.wall[field::position];
        sim.wall_start.assign(of_walls.begin(), of_walls.end());
        if (plan.runs("seepage")) {
            for (const BodySettings& body : scene.bodies) {
                sim.seepage.open.push_back(body.sealed ? 0 : 1);
            }
        }
        fly_bodies(sim, 0);
        if (plan.runs(OpenSides::name)) {
            start_open(sim);
        }
        update_lists(sim);
        update_pressure(*sim.fluid);
        // Initial rates, so that the first half step compresses the fluid like all later ones.
        update_rates(*sim.fluid);
        sim.waves = make_waves(sim);
        sim.bed = make_bed_friction(sim);
    }
    sim.conservation.start = totals(sim);
    return sim;
}

} // namespace hyoryu
