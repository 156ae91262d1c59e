// SPDX-License-Identifier: MIT
#include "hyoryu/sim/checkpoint.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/fluid/whole.hpp"
#include "hyoryu/sim/state_parts.hpp"

#include "state.hpp"
#include "tiles_state.hpp"
#include "work_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hyoryu {

namespace {

// State of solid particles: friction, which acts a step later, and the image used by the lists.
using LastingOfSolids = Fields<Position, ViscousForce>;

bool lasts(const Fluid& fluid, Position)
{
    return fluid.moving_walls && fluid.period != Vec3(0, 0, 0);
}
bool lasts(const Fluid& fluid, ViscousForce)
{
    return sticks_to_solids(fluid) && fluid.particles.wall.has(field::viscous_force);
}

// The search for neighbours turns places into numbers of cells.
void check_places(std::span<const Vec3> places)
{
    if (!std::ranges::all_of(places, [](const Vec3& x) { return x.allFinite(); })) {
        throw IoError("the checkpoint has particles without a finite position: it is damaged");
    }
}

// A column of wall particles, of which a rank takes those that it has.
template <class T>
void read_wall_column(StateReader& state, const std::string& name, const std::string& unit,
                      const WallRows& rows, Index moving, std::span<T> own)
{
    std::vector<T> all(at(rows.all));
    state.values(name, unit, std::span(all));
    std::copy_n(all.begin(), moving, own.begin());
    std::copy_n(all.begin() + rows.first, std::ssize(own) - moving, own.begin() + moving);
}

// The tiles of walls of which some move, of which a rank takes its own.
void read_wall_tiles(StateReader& state, Fluid& fluid, const WallRows& rows)
{
    Tiles& tiles = fluid.neighbours.wall;
    describe_tiles(state, tiles, "wall/tiles");
    check_tiles(tiles, {0, rows.all});
    keep_tiles(tiles, own_tiles(fluid));
    const Index moving = fluid.fixed_walls.moving_rows;
    for (std::int32_t& row : tiles.row) {
        row -= row >= moving ? static_cast<std::int32_t>(rows.first - moving) : 0;
    }
    check_tiles(tiles, fluid.particles.wall.rows());
}

// All ranks have the rows of walls that move; each has the friction on those in its tiles.
void forget_friction_of_others(Fluid& fluid)
{
    Store& wall = fluid.particles.wall;
    if (!fluid.ghosts || !wall.has(field::viscous_force)) {
        return;
    }
    std::vector<bool> is_own(at(wall.size()), false);
    for (const std::int32_t row : fluid.neighbours.wall.row) {
        is_own[at(row)] = true;
    }
    const auto F = wall[field::viscous_force];
    for (Index row = 0; row < fluid.fixed_walls.moving_rows; ++row) {
        F[row] = is_own[at(row)] ? Vec3(F[row]) : Vec3(0, 0, 0);
    }
}

// Which fixed walls have rows follows from the tiles of fluid and bodies.
void read_solids(StateReader& state, Fluid& fluid)
{
    Store& wall = fluid.particles.wall;
    Store& body = fluid.particles.body;
    describe_tiles(state, fluid.neighbours.body, "body/tiles");
    check_tiles(fluid.neighbours.body, body.rows());
    place_fixed_walls(fluid);
    const WallRows rows = wall_rows(fluid);
    for_each(LastingOfSolids{}, [&](auto column) {
        if (lasts(fluid, column)) {
            const std::string name(column.info.name);
            const std::string unit(column.info.unit);
            read_wall_column(state, "wall/" + name, unit, rows, fluid.fixed_walls.moving_rows,
                             wall[column]);
            state.values("body/" + name, unit, std::span(body[column]));
        }
    });
    if (fluid.moving_walls) {
        read_wall_tiles(state, fluid, rows);
        forget_friction_of_others(fluid);
    }
}

template <class State>
void write_solids(State& state, const Fluid& fluid)
{
    const Store& wall = fluid.particles.wall;
    const Store& body = fluid.particles.body;
    describe_tiles(state, fluid.neighbours.body, "body/tiles");
    for_each(LastingOfSolids{}, [&](auto column) {
        if (lasts(fluid, column)) {
            const std::string name(column.info.name);
            const std::string unit(column.info.unit);
            state.values("wall/" + name, unit, std::span(wall[column]));
            state.values("body/" + name, unit, std::span(body[column]));
        }
    });
    if (fluid.moving_walls) {
        describe_tiles(state, fluid.neighbours.wall, "wall/tiles");
    }
    if (fluid.ghosts) {
        state(rows_of_fixed_walls, "", Index{wall.size() - fluid.fixed_walls.moving_rows});
    }
}

// Rows for the particles of a checkpoint: those that were lost leave the store, which of them does
// not matter; others come from open sides, or from another rank.
void fit(Store& store, std::size_t kept)
{
    std::vector<std::int32_t> order(kept, -1);
    std::iota(order.begin(),
              order.begin() + std::min<std::ptrdiff_t>(std::ssize(order), store.size()), 0);
    store.gather(order);
}

template <class State, class Fluid>
void describe_fluid(State& state, Fluid& fluid)
{
    auto& store = fluid.particles.fluid;
    if constexpr (State::reads) {
        std::vector<std::int64_t> ids;
        state.list("fluid/id", "", ids);
        fit(store, ids.size());
    }
    state.values("fluid/id", "", std::span(store.id()));
    store.for_each_column([&](const FieldInfo& column, auto& values) {
        if (column.state) {
            state.values(fmt::format("fluid/{}", column.name), std::string(column.unit),
                         std::span(values));
        }
    });
    if constexpr (State::reads) {
        check_places(std::span(store[field::position]));
    }
    state("fluid/list_builds", "", fluid.neighbours.builds);
    state("fluid/list_steps", "", fluid.neighbours.steps);
    state("fluid/skin_of_fluid", "m", fluid.neighbours.skins.fluid);
    state("fluid/skin_of_solids", "m", fluid.neighbours.skins.solid);
    state("fluid/lost", "", fluid.lost.count);
    state("fluid/lost_momentum", "kg m/s", fluid.lost.momentum);
    state("fluid/lost_energy", "J", fluid.lost.energy);
    describe_tiles(state, fluid.neighbours.fluid, "fluid/tiles");
    if constexpr (State::reads) {
        check_tiles(fluid.neighbours.fluid, store.rows());
        read_solids(state, fluid);
        rebuild_neighbours(fluid);
    } else {
        write_solids(state, fluid);
    }
}

template <class State, class Rigid>
void describe_rigid(State& state, Rigid& rigid)
{
    state.each("bodies/position", "m", rigid.bodies, &Body::position);
    state.each("bodies/orientation", "", rigid.bodies, &Body::orientation);
    state.each("bodies/velocity", "m/s", rigid.bodies, &Body::velocity);
    state.each("bodies/angular_momentum", "kg m2/s", rigid.bodies, &Body::angular_momentum);
    ContactStart start;
    if constexpr (!State::reads) {
        start = contact_start(rigid);
    }
    state.list("contacts/features", "", start.features);
    state.list("contacts/forces", "N", start.forces);
    state.list("contacts/places", "m", start.places);
    state.list("contacts/rubs", "m", start.rubs);
    state.list("contacts/stuck", "", start.stuck);
    if constexpr (State::reads) {
        set_contact_start(rigid, start);
    }
    auto& counters = rigid.counters;
    state("contacts/impacts", "", counters.impacts);
    state("contacts/rounds", "", counters.rounds);
    state("contacts/events", "", counters.events);
    state("contacts/tangential_impacts", "", counters.tangential_impacts);
    state("contacts/capped_steps", "", counters.capped_steps);
    state("contacts/worst_residual", "m/s", counters.worst_residual);
    state("contacts/worst_penetration", "m", counters.worst_penetration);
}

template <class State, class Conservation>
void describe_conservation(State& state, Conservation& sums)
{
    auto& start = sums.start;
    state("sums/start_fluid_kinetic", "J", start.fluid_kinetic);
    state("sums/start_fluid_potential", "J", start.fluid_potential);
    state("sums/start_fluid_internal", "J", start.fluid_internal);
    state("sums/start_body_kinetic", "J", start.body_kinetic);
    state("sums/start_body_potential", "J", start.body_potential);
    state("sums/start_momentum", "kg m/s", start.momentum);
    state("sums/start_momentum_scale", "kg m/s", start.momentum_scale);
    state("sums/contact_loss", "J", sums.contact_loss);
    state("sums/wall_impulse", "N s", sums.wall_impulse);
    state("sums/gravity_impulse", "N s", sums.gravity_impulse);
    state("sums/worst_closure", "", sums.worst_closure);
    state("sums/worst_density_error", "", sums.worst_density_error);
    state("sums/worst_in_solids", "", sums.worst_in_solids);
}

// Paddles that absorb: what they add to their paths, and the levels that they saw.
template <class State, class Simulation>
void describe_absorbers(State& state, Simulation& sim)
{
    auto& absorbers = sim.waves.absorbers;
    const auto added = [&sim](auto member) {
        return [&sim, member ](const Absorber& absorber) -> auto&
        {
            return (*sim.scene.walls[absorber.wall].motion.absorption).*member;
        };
    };
    state.each("absorbers/time", "s", absorbers, added(&Motion::Absorption::time));
    state.each("absorbers/place", "m", absorbers, added(&Motion::Absorption::place));
    state.each("absorbers/velocity", "m/s", absorbers, added(&Motion::Absorption::velocity));
    state.each("absorbers/level", "m", absorbers, &Absorber::level);
    state.each("absorbers/still", "", absorbers, &Absorber::still);
    if constexpr (State::reads) {
        for (const Absorber& absorber : absorbers) {
            sim.rigid.boundaries[absorber.wall].motion.absorption =
                sim.scene.walls[absorber.wall].motion.absorption;
        }
    }
}

// Whether the bodies that left and their open sides belong to the case, and none is listed twice.
bool are_of_case(const Simulation& sim, std::vector<LeftBody> left)
{
    const auto is_below = [](std::size_t count) {
        return [count](int k) { return k >= 0 && at(k) < count; };
    };
    std::ranges::sort(left, {}, &LeftBody::body);
    return std::ranges::all_of(left, is_below(sim.rigid.bodies.size()), &LeftBody::body) &&
           std::ranges::all_of(left, is_below(sim.scene.open.size()), &LeftBody::side) &&
           std::ranges::adjacent_find(left, {}, &LeftBody::body) == left.end();
}

template <class State, class Boundary>
void describe_open(State& state, Boundary& open)
{
    state("open/next_id", "", open.next_id);
    state("open/impulse", "N s", open.impulse);
    state("open/energy", "J", open.energy);
    for (std::size_t k = 0; k < open.carpets.size(); ++k) {
        const std::string name = fmt::format("open/{}/", k);
        auto& carpet = open.carpets[k];
        state.each(name + "depth", "m", carpet.stations, &StationFlow::depth);
        state.each(name + "drift", "m/s", carpet.stations, &StationFlow::drift);
        state.each(name + "level", "m", carpet.stations, &StationFlow::level);
        state.each(name + "velocity", "m/s", carpet.stations, &StationFlow::velocity);
        state.each(name + "passes", "", carpet.stations, &StationFlow::passes);
        state.values(name + "carry", "", std::span(carpet.carry));
        state(name + "made", "", carpet.made);
        state(name + "dropped", "", carpet.dropped);
        state(name + "in", "", carpet.in);
        state(name + "out", "", carpet.out);
        state(name + "volume_asked", "m3", carpet.volume_asked);
        state(name + "moved", "m", carpet.moved);
    }
}

// Before the particles: those of the bodies that left are not there.
template <class State, class Simulation>
void describe_left_bodies(State& state, Simulation& sim)
{
    auto& left = sim.open.left;
    state.resize("open/left/body", left, &LeftBody::body);
    state.each("open/left/body", "", left, &LeftBody::body);
    state.each("open/left/side", "", left, &LeftBody::side);
    state.each("open/left/time", "s", left, &LeftBody::time);
    state.each("open/left/position", "m", left, &LeftBody::position);
    state.each("open/left/velocity", "m/s", left, &LeftBody::velocity);
    if constexpr (State::reads) {
        if (!are_of_case(sim, left)) {
            throw IoError("the checkpoint lists bodies that left the domain, but they are not in "
                          "this case: it is damaged or belongs to another case");
        }
        remove_left_bodies(sim);
    }
}

template <class State, class Simulation>
void describe_all(State& state, Simulation& sim)
{
    describe_clock(state, sim.clock);
    describe_conservation(state, sim.conservation);
    state.each("loads/force", "N", sim.loads.bodies, &Wrench::force);
    state.each("loads/torque", "N m", sim.loads.bodies, &Wrench::torque);
    if (!sim.scene.gauges.empty()) {
        describe_gauges(state, sim.gauges);
    }
    if (!sim.waves.absorbers.empty()) {
        describe_absorbers(state, sim);
    }
    if (!sim.seepage.open.empty()) {
        state.list("joints", "", sim.seepage.joined);
        state.list("joint_opening", "m/s", sim.seepage.opening);
        state.list("joint_pressure", "Pa", sim.seepage.pressure);
        state.list("joint_inertia", "Pa", sim.seepage.inertia);
        if constexpr (State::reads) {
            restart_joints(sim.seepage);
        }
    }
    describe_rigid(state, sim.rigid);
    if (sim.open.runs()) {
        describe_left_bodies(state, sim);
    }
    if (sim.fluid) {
        describe_fluid(state, *sim.fluid);
    }
    if (sim.open.runs()) {
        describe_open(state, sim.open.boundary);
        if constexpr (State::reads) {
            find_rows(*sim.fluid, sim.open.boundary);
        }
    }
}

} // namespace

void check_tiles(const Tiles& tiles, Rows rows)
{
    const auto is_finite = [](float a) { return std::isfinite(a); };
    const auto is_a_row = [&](std::int32_t row) { return row >= rows.begin && row < rows.end; };
    const bool whole =
        tiles.start.size() == tiles.tile.size() + 1 && tiles.start.front() == 0 &&
        tiles.start.back() == tiles.count() && tiles.count() <= rows.size() &&
        tiles.x.size() == tiles.row.size() && tiles.y.size() == tiles.row.size() &&
        tiles.z.size() == tiles.row.size() && std::ranges::is_sorted(tiles.start) &&
        std::ranges::is_sorted(tiles.tile) && std::ranges::all_of(tiles.row, is_a_row) &&
        std::ranges::all_of(tiles.x, is_finite) && std::ranges::all_of(tiles.y, is_finite) &&
        std::ranges::all_of(tiles.z, is_finite);
    if (!whole) {
        throw IoError("the checkpoint has tiles that do not fit its particles: it is damaged");
    }
}

void expect_particles_of_case(const Simulation& sim, Index particles)
{
    if (!sim.fluid || sim.open.runs()) { // which may have added any number
        return;
    }
    if (particles > sim.plan.counts.fluid) {
        throw IoError(fmt::format("the checkpoint has {} fluid particles, which cannot be a subset "
                                  "of the {} of this case: it belongs to another case",
                                  particles, sim.plan.counts.fluid));
    }
}

Snapshot save(const Simulation& sim)
{
    Snapshot snapshot;
    StateWriter state(snapshot);
    describe_all(state, sim);
    write_work(state, sim, count_visits(sim));
    return snapshot;
}

StateOnDemand state_of(const Simulation& sim)
{
    const double visits = count_visits(sim);
    StateSizes all;
    describe_all(all, sim);
    write_work(all, sim, visits);
    return {.bytes = std::move(all.bytes),
            .array =
                [&sim, visits](const std::string& name) {
                    StateArray one(name);
                    describe_all(one, sim);
                    write_work(one, sim, visits);
                    return std::move(one.column);
                },
            .texts = {}};
}

void restore(Simulation& sim, const Snapshot& snapshot)
{
    std::vector<std::int64_t> numbers;
    if (sim.fluid) {
        StateReader(snapshot).list("fluid/id", "", numbers);
    }
    expect_particles_of_case(sim, std::ssize(numbers));
    restore_share(sim, snapshot);
}

void restore_share(Simulation& sim, const Snapshot& snapshot)
{
    StateReader state(snapshot);
    describe_all(state, sim);
    read_work(snapshot, sim);
    sim.last.reset();
}

double time_of(const Snapshot& snapshot)
{
    Clock clock;
    StateReader state(snapshot);
    describe_clock(state, clock);
    return clock.time;
}

} // namespace hyoryu
