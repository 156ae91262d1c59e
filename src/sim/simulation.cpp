// SPDX-License-Identifier: MIT
#include "hyoryu/sim/simulation.hpp"

#include "hyoryu/sim/watch.hpp"

#include "parts.hpp"

namespace hyoryu {

namespace {

// Sets positions and velocities of body particles from the poses and motions of the bodies.
void place_bodies(Simulation& sim)
{
    if constexpr (is_built<BodyLoad>) {
        place_bodies(sim.rigid, sim.poses, sim.body_particles, *sim.fluid);
    }
}

bool has_open_sides(const Simulation& sim)
{
    return is_built<OpenSides> && sim.open.runs();
}

} // namespace

void fly_bodies(Simulation& sim, double ahead)
{
    if constexpr (is_built<BodyLoad>) {
        sim.poses = free_flight(sim.rigid, ahead);
    }
    place_bodies(sim);
}

void update_lists(Simulation& sim)
{
    share_places(*sim.fluid);
    if (has_open_sides(sim)) {
        renew_open(sim);
        share_places(*sim.fluid); // and the densities that the carpets have now
    } else {
        update_neighbours(*sim.fluid);
    }
}

namespace {

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

// Updates the joints under standing bodies, at the middle of the step.
void seep(Simulation& sim, double dt)
{
    if (has_seepage(sim)) {
        update_joints(sim.seepage, sim.rigid, sim.poses, sim.body_particles,
                      {sim.clock.time + dt / 2, dt, sim.clock.dt}, *sim.fluid);
    }
}

// Whether some part of the simulation needs the loads in the middle of a step.
bool needs_loads(const Simulation& sim)
{
    return (is_built<RigidMotion> && sim.plan.rigid) ||
           (is_built<Gauges> && !sim.gauges.forces.empty());
}

// The last barrier on exact surfaces, in the middle of a step.
void hold_fluid(Simulation& sim, double dt)
{
    if (is_built<SurfaceBarrier> && sim.barrier) {
        sim.timer.begin("barrier");
        hold_at_solids(sim, sim.clock.time + dt / 2, dt);
    }
}

// Computes the new velocities: by the forces, then modified by sponges, solid surfaces, rough beds
// and open sides. Completing the loads includes the recoil of light bodies.
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
    if (needs_loads(sim)) {
        sim.timer.begin("loads");
        total_loads(sim);
    }
}

} // namespace

void step(Simulation& sim)
{
    const StepStart start{sim.last ? *sim.last : survey(sim), outflow_before(sim)};
    const NextStep next = next_step(sim.clock, sim.scene, time_limit(sim, start.survey));
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
        cover_walls(sim, sim.clock.time + dt / 2);
        sim.timer.begin("pressure");
        update_pressure(fluid);
        seep(sim, dt);
        sim.timer.begin("forces");
        update_forces(fluid, dt);
        sim.timer.begin("loads");
        begin_loads(sim);
        kick_fluid(sim, dt);
    }
    if (is_built<RigidMotion> && sim.plan.rigid) {
        sim.timer.begin("bodies");
        step(sim.rigid, sim.clock.time, dt, sim.loads.bodies, sim.contacts, sim.comm);
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
    sim.last = survey(sim);
    update_conservation(sim, start, *sim.last, dt);
    sim.timer.begin("watch");
    watch(sim, *sim.last);
    sim.timer.end();
}

} // namespace hyoryu
