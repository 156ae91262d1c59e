// SPDX-License-Identifier: MIT
#include "hyoryu/sim/simulation.hpp"

#include "hyoryu/core/built_effects.hpp"
#include "hyoryu/scene/rigid_scene.hpp"
#include "hyoryu/scene/shapes.hpp"
#include "hyoryu/scene/wall_layers.hpp"
#include "hyoryu/sim/watch.hpp"

#include <cmath>
#include <numeric>
#include <string_view>

namespace hyoryu {

namespace {

// Optional parts of a step besides the effects of the fluid, by the names of the plan.
struct RigidMotion {
    static constexpr std::string_view name = "rigid_motion";
};
struct BodyLoad {
    static constexpr std::string_view name = "body_load";
};
struct JointSeepage {
    static constexpr std::string_view name = "seepage";
};
struct MovingWalls {
    static constexpr std::string_view name = "moving_walls";
};
struct SurfaceBarrier {
    static constexpr std::string_view name = "wall_barrier";
};
struct Sponges {
    static constexpr std::string_view name = "sponge";
};
struct RoughBeds {
    static constexpr std::string_view name = "bed_friction";
};
struct WaveAbsorption {
    static constexpr std::string_view name = "wave_absorption";
};
struct OpenSides {
    static constexpr std::string_view name = "open_boundary";
};
struct Gauges {
    static constexpr std::string_view name = "gauges";
};

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

void fill_fluid_rows(const Filling& filling, Fluid& fluid)
{
    Store& store = fluid.particles.fluid;
    const auto x = store[field::position];
    const auto v = store[field::velocity];
    const auto rho = store[field::density];
    for (std::size_t i = 0; i < filling.fluid.size(); ++i) {
        x[i] = filling.fluid[i];
        v[i] = filling.fluid_velocity[i];
        rho[i] = hydrostatic_density(fluid.parameters, filling.fluid_depth[i]) +
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

// Particles of moving walls take the position of their wall at one time, its velocity at another.
void move_walls(Simulation& sim, double place_time, double velocity_time)
{
    if (!is_built<MovingWalls> || sim.wall_start.empty()) {
        return;
    }
    std::vector<Vec3> places;
    std::vector<Vec3> velocities;
    for (const Wall& wall : sim.scene.walls) {
        places.push_back(displacement(wall.motion, place_time));
        velocities.push_back(velocity(wall.motion, velocity_time));
    }
    Store& store = sim.fluid->particles.wall;
    const auto x = store[field::position];
    const auto v = store[field::velocity];
    const auto owner = store.owner();
    const TileLattice& lattice = sim.fluid->neighbours.wall.lattice;
    parallel_for(0, static_cast<Index>(sim.wall_start.size()), [&](Index i) {
        const auto wall = at(-1 - owner[i]);
        // In a periodic domain the image that the lists know.
        const Vec3 place = sim.wall_start[at(i)] + places[wall];
        x[i] = lattice.image_near(place, x[i]);
        v[i] = velocities[wall];
    });
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

Fluid make_fluid(const Simulation& sim, const Filling& filling)
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
    allocate(fluid, static_cast<Index>(filling.fluid.size()), fluid.fixed_walls.moving_rows,
             static_cast<Index>(sim.body_particles.points.size()));
    fill_fluid_rows(filling, fluid);
    fill_wall_rows(sim.scene, filling, fluid);
    fill_body_rows(sim, filling, fluid);
    return fluid;
}

// Sets positions and velocities of body particles from the poses and motions of the bodies.
void place_bodies(Simulation& sim)
{
    if constexpr (is_built<BodyLoad>) {
        place_bodies(sim.rigid, sim.poses, sim.body_particles, *sim.fluid);
    }
}

// The poses after flying freely for so long.
void fly_bodies(Simulation& sim, double ahead)
{
    if constexpr (is_built<BodyLoad>) {
        sim.poses = free_flight(sim.rigid, ahead);
    }
    place_bodies(sim);
}

bool has_seepage(const Simulation& sim)
{
    return is_built<JointSeepage> && !sim.seepage.open.empty();
}

// The joints under standing bodies, at the middle of the step.
void seep(Simulation& sim, double dt)
{
    if (has_seepage(sim)) {
        update_joints(sim.seepage, sim.rigid, sim.poses, sim.body_particles,
                      {sim.clock.time + dt / 2, dt}, *sim.fluid);
    }
}

void load_solids(Simulation& sim)
{
    if constexpr (is_built<BodyLoad>) {
        collect_loads(*sim.fluid, sim.poses, sim.loads.sums, sim.loads.bodies);
    }
    sim.loads.walls.resize(sim.scene.walls.size());
    collect_wall_forces(*sim.fluid, sim.loads.sums_of_walls, sim.loads.walls);
    if (has_seepage(sim)) {
        add_joint_loads(sim.seepage, *sim.fluid, sim.poses, sim.loads.bodies, sim.loads.walls);
    }
}

// The last barrier on exact surfaces, in the middle of a step.
void hold_fluid(Simulation& sim, double dt)
{
    if (is_built<SurfaceBarrier> && sim.barrier) {
        sim.timer.begin("barrier");
        hold_at_solids(sim, sim.clock.time + dt / 2, dt);
    }
}

bool has_open_sides(const Simulation& sim)
{
    return is_built<OpenSides> && sim.open.runs();
}

// Lists where they are due; the only moment at which fluid rows come and go.
void update_lists(Simulation& sim)
{
    if (has_open_sides(sim)) {
        renew_open(sim);
    } else {
        update_neighbours(*sim.fluid);
    }
}

// The new velocities: of the forces, then of what sponges, solid surfaces and open sides make of
// them.
void kick_fluid(Simulation& sim, double dt)
{
    sim.timer.begin("kick");
    kick(*sim.fluid, dt);
    if (is_built<Sponges> && !sim.scene.sponges.empty()) {
        damp_in_sponges(sim, dt);
    }
    hold_fluid(sim, dt);
    if (is_built<RoughBeds> && !sim.bed.walls.empty()) {
        sim.timer.begin("bed friction");
        rub_on_beds(sim, dt);
    }
    if (has_open_sides(sim)) {
        sim.timer.begin("open sides");
        drive_open(sim, dt);
    }
}

// A step of a fluid particle costs as much as ten updates of a contact, on one thread.
constexpr double updates_of_particle = 10;

} // namespace

Simulation make_simulation(const Scene& scene, const Plan& plan, const Filling& filling)
{
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
        sim.fluid = make_fluid(sim, filling);
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

TimeLimit time_limit(const Simulation& sim)
{
    const std::span<const TimeLimit> limits = sim.plan.limits;
    if (!sim.fluid) {
        return shortest(limits);
    }
    // The limits of light bodies stay; those of the fluid, the first ones, follow its motion.
    const auto now = fluid_limits(*sim.fluid);
    const TimeLimit of_fluid = shortest(now);
    const TimeLimit of_bodies = shortest(limits.subspan(now.size()));
    return of_bodies.dt < of_fluid.dt ? of_bodies : of_fluid;
}

void step(Simulation& sim)
{
    const NextStep next = next_step(sim.clock, sim.scene, time_limit(sim));
    const MomentumBefore before = momentum_before(sim);
    const double dt = next.dt;
    sim.contacts.clear();
    if (sim.fluid) {
        Fluid& fluid = *sim.fluid;
        sim.timer.begin("drift");
        if (is_built<WaveAbsorption> && !sim.waves.absorbers.empty()) {
            absorb_waves(sim, dt);
        }
        drift(fluid, dt / 2);
        move_walls(sim, sim.clock.time + dt / 2, sim.clock.time + dt / 2);
        fly_bodies(sim, dt / 2);
        sim.timer.begin("neighbours");
        update_lists(sim);
        sim.timer.begin("pressure");
        update_pressure(fluid);
        seep(sim, dt);
        sim.timer.begin("forces");
        update_forces(fluid, dt);
        sim.timer.begin("loads");
        load_solids(sim);
        kick_fluid(sim, dt);
    }
    if (is_built<RigidMotion> && sim.plan.rigid) {
        sim.timer.begin("bodies");
        step(sim.rigid, sim.clock.time, dt, sim.loads.bodies, sim.contacts);
    }
    if (is_built<Gauges> && !sim.gauges.forces.empty()) {
        sim.timer.begin("gauges");
        book_forces(sim, dt);
    }
    if (sim.fluid) {
        Fluid& fluid = *sim.fluid;
        sim.timer.begin("rates");
        place_bodies(sim);
        move_walls(sim, sim.clock.time + dt / 2, next.end);
        update_rates(fluid);
        sim.pair_visits += static_cast<double>(fluid.neighbours.visits);
        shift(fluid, dt);
        sim.timer.begin("drift");
        drift(fluid, dt / 2);
        if (has_open_sides(sim)) {
            close_open(sim);
        }
        move_walls(sim, next.end, next.end);
    }
    sim.timer.begin("books");
    sim.clock.time = next.end;
    sim.clock.dt = dt;
    sim.clock.step += 1;
    sim.steps_by_limit[next.limit] += 1;
    update_conservation(sim, before, dt);
    sim.timer.begin("watch");
    watch(sim);
    sim.timer.end();
}

} // namespace hyoryu
