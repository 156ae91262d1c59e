// SPDX-License-Identifier: MIT
// A simulation at time 0.
#include "hyoryu/scene/rigid_scene.hpp"
#include "hyoryu/scene/shapes.hpp"
#include "hyoryu/scene/wall_layers.hpp"

#include "own_particles.hpp"
#include "parts.hpp"

#include <cmath>
#include <numeric>

namespace hyoryu {

namespace {

// The compressible hydrostatic density at a depth: rho0 exp(g d / c0^2). Starting from rest
// pressure instead would ring for seconds.
double hydrostatic_density(const FluidParameters& f, double depth)
{
    return f.eos.rho0 * std::exp(f.gravity.norm() * depth / sq(f.eos.c0));
}

void fill_fluid_rows(const Filling& filling, Fluid& fluid)
{
    Store& store = fluid.particles.fluid;
    const auto x = store[field::position];
    const auto v = store[field::velocity];
    const auto rho = store[field::density];
    for (std::size_t k = 0; k < filling.fluid.size(); ++k) {
        store.id()[k] = filling.number_of_fluid(k);
        x[k] = filling.fluid[k];
        v[k] = filling.fluid_velocity.empty() ? Vec3(0, 0, 0) : filling.fluid_velocity[k];
        const double pressure = filling.fluid_pressure.empty() ? 0 : filling.fluid_pressure[k];
        rho[k] = hydrostatic_density(fluid.parameters, filling.fluid_depth[k]) +
                 pressure / sq(fluid.parameters.eos.c0);
    }
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
        const Index index = filling.number_of_wall(k);
        store.id()[row] = fluid.fixed_walls.first_number + index;
        store[field::displaced_mass][row] =
            fluid.fixed_walls.make(static_cast<std::int32_t>(index)).displaced_mass;
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
    std::iota(store.id().begin(), store.id().end(),
              static_cast<std::int64_t>(sim.plan.counts.fluid + sim.plan.counts.wall));
    for (std::size_t b = 0; b < filling.bodies.size(); ++b) {
        const Rows rows = sim.body_particles.of[b];
        const real mass = fluid.parameters.eos.rho0 * filling.bodies[b].particle_volume;
        for (Index k = rows.begin; k < rows.end; ++k) {
            store.owner()[k] = static_cast<std::int32_t>(b);
            store[field::displaced_mass][k] = mass;
            if (store.has(field::depth)) {
                const Placed shape{.shape = &sim.scene.bodies[b].shape,
                                   .centre = middle_of_shape(sim.scene.bodies[b]),
                                   .dimensions = sim.scene.dimensions};
                store[field::depth][k] = -signed_distance(shape, sim.body_particles.points[at(k)]);
            }
        }
        fluid.body_particle_mass.push_back(mass);
    }
}

// The fluid before it has particles.
Fluid empty_fluid(const Scene& scene, const Plan& plan)
{
    Fluid fluid;
    fluid.parameters = *plan.fluid;
    fluid.effects = plan.effects;
    fluid.kernel = make_kernel(fluid.parameters.h, fluid.parameters.spacing,
                               fluid.parameters.dimensions, fluid.parameters.kernel);
    fluid.mps_kernel = make_mps_kernel(fluid.kernel.support, fluid.parameters.spacing,
                                       fluid.parameters.dimensions);
    // A particle may graze the edge of the domain; two spacings beyond it is gone for good.
    const Vec3 margin = Vec3::Constant(2 * fluid.parameters.spacing);
    const Bounds domain = domain_of(scene);
    fluid.domain_min = domain.min - margin;
    fluid.domain_max = domain.max + margin;
    for (Index axis = 0; axis < 3; ++axis) {
        if (scene.domain && scene.domain->periodic[at(axis)]) {
            fluid.domain_min[axis] = domain.min[axis];
            fluid.period[axis] = domain.max[axis] - domain.min[axis];
        }
    }
    extend_domain(scene, fluid);
    return fluid;
}

// Adds the particles of a process; `fluid`: with its walls, and its cuts if it is one of several.
void add_fluid(Simulation& sim, Fluid fluid, const Filling& filling)
{
    if (fluid.fixed_walls.count + fluid.fixed_walls.moving_rows > 0) {
        fluid.fixed_walls.make =
            wall_maker(sim.scene, filling, sim.barrier->solids, mass_of_cube(fluid.parameters));
    }
    allocate(fluid, static_cast<Index>(filling.fluid.size()), fluid.fixed_walls.moving_rows,
             static_cast<Index>(sim.body_particles.points.size()));
    fill_fluid_rows(filling, fluid);
    fill_wall_rows(sim.scene, filling, fluid);
    fill_body_rows(sim, filling, fluid);
    const auto of_walls = fluid.particles.wall[field::position];
    sim.wall_start.assign(of_walls.begin(), of_walls.end());
    sim.fluid = std::move(fluid);
    sim.covered = covered_walls(sim);
}

void add_body_points(Simulation& sim, const std::vector<Aggregate>& bodies)
{
    BodyParticles& particles = sim.body_particles;
    for (const Aggregate& body : bodies) {
        const auto begin = static_cast<Index>(particles.points.size());
        particles.points.insert(particles.points.end(), body.points.begin(), body.points.end());
        particles.of.push_back({begin, static_cast<Index>(particles.points.size())});
    }
}

void add_particles(Simulation& sim, Filling& filling)
{
    add_body_points(sim, filling.bodies);
    if (!sim.plan.fluid) {
        return;
    }
    Fluid fluid = empty_fluid(sim.scene, sim.plan);
    const TileLattice lattice = lattice_of(fluid);
    fluid.fixed_walls = find_fixed_walls(sim.scene, filling, lattice, sim.comm);
    if (sim.comm != nullptr) {
        share(fluid, *sim.comm, deal_out(sim.scene, lattice, *sim.comm, filling));
    }
    add_fluid(sim, std::move(fluid), filling);
}

// A step of a fluid particle costs as much as ten updates of a contact, on one thread.
constexpr double updates_of_particle = 10;

// Joints, bodies and open sides before the first lists.
void prepare_fluid(Simulation& sim)
{
    if (sim.plan.runs("seepage")) {
        for (const BodySettings& body : sim.scene.bodies) {
            sim.seepage.open.push_back(body.sealed ? 0 : 1);
        }
    }
    fly_bodies(sim, 0);
    if (sim.plan.runs(OpenSides::name)) {
        start_open(sim);
    }
}

// Lists, pressures and rates of time 0.
void start_fluid(Simulation& sim)
{
    update_lists(sim);
    update_pressure(*sim.fluid);
    // Initial rates, so that the first half step compresses the fluid like all later ones.
    update_rates(*sim.fluid);
}

void add_waves_and_beds(Simulation& sim)
{
    sim.waves = make_waves(sim);
    sim.bed = make_bed_friction(sim);
}

// The scene with its particles, before the first lists.
Simulation make_unlisted(const Scene& scene, const Plan& plan, Filling filling, Comm* comm)
{
    Simulation sim{.scene = scene, .plan = plan, .comm = comm};
    sim.rigid = make_rigid(scene);
    sim.gauges = make_gauge_memory(scene);
    sim.loads.bodies.resize(scene.bodies.size());
    for (const Body& body : sim.rigid.bodies) {
        sim.thinnest = std::min(sim.thinnest, inner_radius(body, scene.dimensions));
    }
    if (plan.fluid) {
        if (plan.runs(SurfaceBarrier::name)) {
            sim.barrier = make_wall_barrier(scene);
        }
        sim.rigid.settings.located_work = scene.contact.locating_share * updates_of_particle *
                                          static_cast<double>(plan.counts.fluid);
    }
    add_particles(sim, filling);
    filling = {}; // the lists take as much memory
    if (sim.fluid) {
        prepare_fluid(sim);
    }
    return sim;
}

} // namespace

Simulation make_simulation(const Scene& scene, const Plan& plan, Filling filling, Comm* comm)
{
    Simulation sim = make_unlisted(scene, plan, std::move(filling), comm);
    if (sim.fluid) {
        start_fluid(sim);
        add_waves_and_beds(sim);
    }
    sim.conservation.start = totals(sim);
    return sim;
}

Simulation make_to_restore(const Scene& scene, const Plan& plan, Filling filling, Comm* comm)
{
    Simulation sim = make_unlisted(scene, plan, std::move(filling), comm);
    if (sim.fluid) {
        add_waves_and_beds(sim);
    }
    return sim;
}

} // namespace hyoryu
