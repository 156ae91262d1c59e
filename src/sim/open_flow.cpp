// SPDX-License-Identifier: MIT
#include "hyoryu/sim/open_flow.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/memory.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

Carpet make_carpet(const Scene& scene, const OpenSettings& open)
{
    Carpet carpet;
    carpet.side = open_side(scene, open);
    carpet.side.space = strip_spaces(scene, open, carpet.side);
    carpet.power_profile = open.profile == FlowProfile::power;
    carpet.stations.resize(at(carpet.side.stations()));
    carpet.carry.assign(at(carpet.side.lanes()), 0);
    return carpet;
}

// The middle of a station along the window [m].
double place_of(const OpenSide& side, int station)
{
    const int begin = station * side.station_lanes;
    const int end = std::min(begin + side.station_lanes, side.lanes());
    return side.first + 0.5 * (begin + end) * side.lane_width;
}

// The level that a station measures.
double level_at(const Carpet& carpet, int station)
{
    return carpet.side.station_strip(station) + carpet.stations[at(station)].depth;
}

// Width of a window / width of its lanes that no wall at the plane closes: a discharge is that of
// the whole window.
double width_factor(const Carpet& carpet)
{
    if (carpet.side.wall.empty()) {
        return 1;
    }
    int open = 0;
    for (int c = 0; c < carpet.side.stations(); ++c) {
        open += carpet.side.open_lanes(c, level_at(carpet, c));
    }
    return open > 0 ? static_cast<double>(carpet.side.lanes()) / open : 1;
}

// Sets the flow of every station at a time, from the prescribed flow and its own measurements.
void set_flows(Simulation& sim, double time)
{
    const Scene& scene = sim.scene;
    for (std::size_t k = 0; k < sim.open.boundary.carpets.size(); ++k) {
        Carpet& carpet = sim.open.boundary.carpets[k];
        const double factor = width_factor(carpet);
        for (int c = 0; c < carpet.side.stations(); ++c) {
            const StationGround ground{carpet.side.station_bed(c, level_at(carpet, c)),
                                       carpet.side.station_strip(c)};
            if (!(ground.bed < infinity)) {
                continue;
            }
            AskedFlow asked = asked_at(scene.open[k], place_of(carpet.side, c), time,
                                       sim.open.still[k][at(c)], scene.dimensions);
            if (asked.discharge) {
                *asked.discharge *= factor;
            }
            StationFlow& flow = carpet.stations[at(c)];
            flow = flow_at(asked, flow, ground, scene.gravity.norm());
        }
    }
}

void expect_room(const Simulation& sim)
{
    const Index held = count_over_ranks(*sim.fluid, sim.fluid->particles.fluid.size());
    if (static_cast<double>(held) > sim.open.most) {
        throw RoomError(sim.clock.step, sim.clock.time, held,
                        static_cast<std::int64_t>(sim.open.most));
    }
}

} // namespace

void extend_domain(const Scene& scene, Fluid& fluid)
{
    for (const OpenSettings& open : scene.open) {
        const double reach = (carpet_columns(scene, open) + 4) * fluid.parameters.spacing;
        double& low = fluid.domain_min[open.axis()];
        double& high = fluid.domain_max[open.axis()];
        low = open.sign() > 0 ? std::min(low, open.plane() - reach) : low;
        high = open.sign() < 0 ? std::max(high, open.plane() + reach) : high;
    }
}

void start_open(Simulation& sim)
{
    Fluid& fluid = *sim.fluid;
    OpenBoundary& open = sim.open.boundary;
    for (const OpenSettings& settings : sim.scene.open) {
        open.carpets.push_back(make_carpet(sim.scene, settings));
    }
    // The memory of the machine may differ between processes, but their limit must not.
    sim.open.most = sim.scene.most_fluid > 0
                        ? static_cast<double>(sim.scene.most_fluid)
                        : -largest_of_all(fluid, -fluid_in_memory(sim.scene, sim.plan));
    open.next_id = sim.plan.counts.particles();
    find_rows(fluid, open);
    mark_beside_bodies(fluid, open);
    measure_start(fluid, open);
    for (const Carpet& carpet : open.carpets) {
        std::vector<StillWater>& still = sim.open.still.emplace_back();
        for (int c = 0; c < carpet.side.stations(); ++c) {
            const double level = level_at(carpet, c);
            still.push_back({level, std::max(level - carpet.side.station_bed(c, level), 0.0)});
        }
    }
    set_flows(sim, 0);
    renew_carpets(fluid, open);
    find_rows(fluid, open); // lists are made next, and must not make the carpets again
    open.impulse.setZero(); // the first carpets are part of the start
}

void renew_open(Simulation& sim)
{
    Fluid& fluid = *sim.fluid;
    OpenBoundary& open = sim.open.boundary;
    count_crossings(fluid, open);
    mark_beside_bodies(fluid, open);
    if (lists_are_due(fluid, carpets_due(fluid, open))) {
        let_bodies_leave(sim);
        renew_carpets(fluid, open);
        if (sim.clock.step > 0) { // the start is a state to go on from with more room
            expect_room(sim);
        }
        make_lists(fluid);
        find_rows(fluid, open);
        mark_beside_bodies(fluid, open);
    }
    set_densities(fluid, open);
    keep_velocities(fluid, open);
}

void drive_open(Simulation& sim, double dt)
{
    measure_strips(*sim.fluid, sim.open.boundary, dt);
    set_flows(sim, sim.clock.time + dt);
    set_velocities(*sim.fluid, sim.open.boundary, dt);
}

void close_open(Simulation& sim)
{
    count_crossings(*sim.fluid, sim.open.boundary);
    set_densities(*sim.fluid, sim.open.boundary);
}

OpenReading reading_of(const Simulation& sim, std::size_t k)
{
    const Carpet& carpet = sim.open.boundary.carpets[k];
    const FluidParameters& f = sim.fluid->parameters;
    const double particle = f.mass / f.eos.rho0;
    OpenReading reading;
    double width = 0; // of the stations with water
    double area = 0;
    double ground = 0;
    double open = 0; // width of all stations
    for (int c = 0; c < carpet.side.stations(); ++c) {
        const StationFlow& flow = carpet.stations[at(c)];
        if (carpet.side.open_lanes(c, flow.level) == 0) {
            continue;
        }
        const double b = carpet.side.open_width(c, flow.level);
        const double bed = carpet.side.station_bed(c, flow.level);
        const double depth = std::max(flow.level - bed, 0.0);
        const double wet = depth > f.spacing / 4 ? b : 0;
        open += b;
        ground += b * bed;
        width += wet;
        area += b * depth;
        reading.level += wet * flow.level;
        reading.discharge += b * depth * flow.velocity;
    }
    reading.level = width > 0 ? reading.level / width : ground / (open > 0 ? open : 1);
    reading.velocity = area > 0 ? reading.discharge / area : 0;
    reading.volume_in = particle * static_cast<double>(carpet.in);
    reading.volume_out = particle * static_cast<double>(carpet.out);
    reading.volume_asked = carpet.volume_asked;
    return reading;
}

} // namespace hyoryu
