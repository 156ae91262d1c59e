// SPDX-License-Identifier: MIT
#include "summary.hpp"

#include "build_info.hpp"

#include "hyoryu/core/parallel.hpp"
#include "hyoryu/sim/watch.hpp"

#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <cstdio>
#include <fstream>
#include <string>

namespace hyoryu {

namespace {

using nlohmann::ordered_json;

ordered_json array(const Vec3& v)
{
    return {v.x(), v.y(), v.z()};
}

ordered_json energies(const Totals& t)
{
    return {{"fluid_kinetic", t.fluid_kinetic},
            {"fluid_potential", t.fluid_potential},
            {"fluid_internal", t.fluid_internal},
            {"body_kinetic", t.body_kinetic},
            {"body_potential", t.body_potential}};
}

ordered_json seconds_by_stage(const StageTimer& timer)
{
    ordered_json seconds = ordered_json::object();
    for (const StageTimer::Stage& stage : timer.stages()) {
        seconds[stage.name] = stage.seconds;
    }
    return seconds;
}

ordered_json contact_counters(const Simulation& sim, std::int64_t steps)
{
    const RigidCounters& c = sim.rigid.counters;
    return {{"impacts", c.impacts},
            {"rounds", c.rounds},
            {"events", c.events},
            {"tangential_impacts", c.tangential_impacts},
            {"capped_steps", c.capped_steps},
            {"steps_located", steps - c.capped_steps},
            {"worst_residual", c.worst_residual},
            {"worst_penetration", worst_penetration(sim)}};
}

ordered_json bodies_left(const Simulation& sim)
{
    ordered_json list = ordered_json::array();
    for (const LeftBody& left : sim.open.left) {
        list.push_back({{"name", sim.rigid.bodies[static_cast<std::size_t>(left.body)].name},
                        {"side", sim.scene.open[static_cast<std::size_t>(left.side)].name},
                        {"time", left.time},
                        {"position", array(left.position)},
                        {"velocity", array(left.velocity)}});
    }
    return list;
}

ordered_json names_outside(const Simulation& sim)
{
    ordered_json names = ordered_json::array();
    for (const int b : bodies_outside(sim)) {
        names.push_back(sim.rigid.bodies[static_cast<std::size_t>(b)].name);
    }
    return names;
}

// Rows of fluid are a whole number: those of the start + made - dropped - lost.
ordered_json open_sides(const Simulation& sim, Index fluid)
{
    ordered_json list = ordered_json::array();
    std::int64_t rows = sim.plan.counts.fluid - sim.fluid->lost.count;
    for (std::size_t k = 0; k < sim.open.boundary.carpets.size(); ++k) {
        const Carpet& carpet = sim.open.boundary.carpets[k];
        const OpenReading reading = reading_of(sim, k);
        rows += carpet.made - carpet.dropped;
        list.push_back({{"name", sim.scene.open[k].name},
                        {"made", carpet.made},
                        {"dropped", carpet.dropped},
                        {"in", carpet.in},
                        {"out", carpet.out},
                        {"volume_in", reading.volume_in},
                        {"volume_out", reading.volume_out},
                        {"volume_asked", reading.volume_asked}});
    }
    return {{"sides", list},
            {"fluid_at_start", sim.plan.counts.fluid},
            {"unaccounted_particles", fluid - rows},
            {"energy_in", sim.open.boundary.energy},
            {"bodies_left", bodies_left(sim)}};
}

// Adds the program, the extent and the settings of the run.
void add_run(ordered_json& json, const Simulation& sim, const std::string& exit_reason,
             double wall_seconds)
{
    json["version"] = build_info::version;
    json["commit"] = build_info::commit;
    json["exit_reason"] = exit_reason;
    json["steps"] = sim.clock.step;
    json["simulated_seconds"] = sim.clock.time;
    json["wall_seconds"] = wall_seconds;
    json["threads"] = thread_count();
    if (sim.fluid) {
        json["precision"] = name(sim.scene.precision);
        json["instruction_set"] = name(sim.fluid->instruction_set);
    }
    json["dimensions"] = sim.scene.dimensions;
    json["per_metre_of_width"] = sim.scene.dimensions == 2;
}

// Particle-steps and pairs per second of this call of the program, which made `steps` steps; the
// number of pairs is that of the whole run.
void add_rates(ordered_json& json, const Simulation& sim, const Closing& now, std::int64_t steps,
               double wall_seconds)
{
    const auto count = static_cast<double>(steps);
    json["particle_steps_per_second"] =
        wall_seconds > 0 ? static_cast<double>(sim.plan.counts.particles()) * count / wall_seconds
                         : 0;
    json["fluid_particle_steps_per_second"] =
        wall_seconds > 0 ? static_cast<double>(now.fluid) * count / wall_seconds : 0;
    json["pair_interactions"] = sim.earlier_visits + now.pair_visits;
    json["pairs_per_second"] = wall_seconds > 0 ? now.pair_visits / wall_seconds : 0;
}

ordered_json momenta(const Simulation& sim, const Totals& end)
{
    return {{"start", array(sim.conservation.start.momentum)},
            {"end", array(end.momentum)},
            {"wall_impulse", array(sim.conservation.wall_impulse)},
            {"gravity_impulse", array(sim.conservation.gravity_impulse)},
            {"open_impulse", array(sim.open.boundary.impulse)},
            {"lost", array(sim.fluid ? sim.fluid->lost.momentum : Vec3(Vec3::Zero()))},
            {"worst_closure_of_a_step", sim.conservation.worst_closure}};
}

} // namespace

double peak_memory()
{
    // getrusage reports the peak of the process that started this one if that peak was larger.
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        double kib = 0;
        if (std::sscanf(line.c_str(), "VmHWM: %lf kB", &kib) == 1) {
            return 1024 * kib;
        }
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

std::string summary_json(const Simulation& sim, const Closing& now, const std::string& exit_reason,
                         double wall_seconds, std::int64_t first_step, const StageTimer& output,
                         const FrameWriter::Cost& frames)
{
    const auto& n = sim.plan.counts;
    ordered_json json;
    add_run(json, sim, exit_reason, wall_seconds);
    add_rates(json, sim, now, sim.clock.step - first_step, wall_seconds);
    json["peak_memory_bytes"] = peak_memory();
    if (now.ranks) {
        json["ranks"] = {{"count", now.ranks->count},
                         {"imbalance", now.ranks->imbalance},
                         {"waited_share", now.ranks->waited},
                         {"rebalances", now.ranks->rebalances}};
    }
    json["stages"] = seconds_by_stage(sim.timer);
    json["output"] = seconds_by_stage(output);
    json["frame_writer"] = {{"files", frames.files},
                            {"thread_seconds", frames.thread_seconds},
                            {"waited_seconds", frames.waited_seconds}};
    json["steps_by_limit"] = ordered_json(sim.steps_by_limit);
    json["share_of_time_step"] = sim.clock.share; // below 1 after recoveries
    json["neighbour_builds"] = sim.fluid ? sim.fluid->neighbours.builds : 0;
    json["counts"] = {{"fluid", now.fluid},
                      {"wall", n.wall},
                      {"body", n.body},
                      {"bodies", n.bodies},
                      {"walls", n.walls}};
    if (sim.fluid) {
        json["fluid_particle_mass"] = sim.fluid->parameters.mass; // [kg], [kg/m] in two dimensions
    }
    json["particles_lost"] = sim.fluid ? sim.fluid->lost.count : 0;
    if (sim.open.runs()) {
        json["open"] = open_sides(sim, now.fluid);
    }
    if (sim.fluid) {
        json["particles_in_solids"] = now.in_solids;
        json["worst_particles_in_solids"] =
            std::max(now.in_solids, sim.conservation.worst_in_solids);
        json["bodies_outside"] = names_outside(sim);
    }
    json["worst_density_error"] = sim.conservation.worst_density_error;
    json["energy"] = {{"start", energies(sim.conservation.start)},
                      {"end", energies(now.totals)},
                      {"contact_loss", sim.conservation.contact_loss}};
    json["momentum"] = momenta(sim, now.totals);
    json["contact"] = contact_counters(sim, sim.clock.step);
    return json.dump(2) + "\n";
}

} // namespace hyoryu
