// SPDX-License-Identifier: MIT
#include "plan_report.hpp"
#include "scale_report.hpp"

#include "forecast.hpp"
#include "machine_load.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "hyoryu/core/parallel.hpp"
#include "hyoryu/scene/disk.hpp"
#include "hyoryu/scene/memory.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

using nlohmann::ordered_json;

ordered_json cost_json(const StepCost& cost)
{
    ordered_json json{{"seconds_per_step", seconds_of_run(cost)},
                      {"seconds_per_first_step", cost.seconds},
                      {"waiting_for_a_core", cost.waiting},
                      {"slowdown", cost.slowdown},
                      {"development", nullptr},
                      {"effects", ordered_json::object()},
                      {"effects_spread", ordered_json::object()}};
    if (cost.development) {
        const Development& d = *cost.development;
        json["development"] = {
            {"coarsening", d.coarsening}, {"steps", d.steps},     {"step", d.step},
            {"builds", d.builds},         {"seconds", d.seconds}, {"fluid", d.fluid},
            {"impacts", d.impacts}};
    }
    for (const StepCost::Share& share : cost.effects) {
        json["effects"][share.effect] = share.share;
        json["effects_spread"][share.effect] = share.spread;
    }
    return json;
}

std::string gauge_lines(const Scene& scene, const Plan& plan)
{
    if (plan.gauges.empty()) {
        return {};
    }
    std::string text = fmt::format(
        "  gauges, one row {}: about {:.0f} rows, {} of computing time\n",
        scene.output.gauge_every > 0 ? fmt::format("every {} s", scene.output.gauge_every)
                                     : "every step",
        plan.gauge_rows, readable_seconds(gauge_seconds(plan)));
    for (const auto& gauge : plan.gauges) {
        text += fmt::format("    {:<22} {}\n{:27}columns {}\n", gauge.name, gauge.what, "",
                            gauge.columns);
    }
    return text;
}

std::string open_lines(const Plan& plan)
{
    if (plan.open.empty()) {
        return {};
    }
    std::string text = fmt::format("  open sides, at most about {} fluid particles, with "
                                   "those outside the windows\n",
                                   plan.most_fluid);
    for (const auto& open : plan.open) {
        text += fmt::format("    {:<22} {}\n", open.name, open.what);
    }
    return text;
}

std::string join_effects(const std::vector<Plan::Effect>& effects)
{
    std::string text;
    for (const auto& effect : effects) {
        text += fmt::format("    {:<22} {}\n", effect.name, effect.why);
    }
    return text;
}

// Restitution and friction of every two materials that can meet, and the rule that gives them.
constexpr const char* mixing_rule =
    "the entry of `contact.pair` that names both materials, else `[contact]`; nothing is averaged";

std::string material_lines(const Scene& scene, const Plan& plan)
{
    if (plan.materials.empty()) {
        return {};
    }
    const auto named = [](const std::string& name) { return name.empty() ? "(none)" : name; };
    std::string text = fmt::format("  contact of materials: {}\n", mixing_rule);
    for (const auto& pair : plan.materials) {
        const std::string who =
            fmt::format("{} - {}", named(pair.materials[0]), named(pair.materials[1]));
        const std::string restitution = scene.contact.penalty ? "from stiffness and damping"
                                                              : fmt::format("{}", pair.restitution);
        const std::string stiffness =
            pair.stiffness ? fmt::format(", stiffness {} N/m (reports)", *pair.stiffness) : "";
        text +=
            fmt::format("    {:<22} restitution {}, friction {}{}, from {}\n", who, restitution,
                        pair.friction, stiffness, pair.listed ? "`contact.pair`" : "`[contact]`");
    }
    return text;
}

ordered_json material_json(const Scene& scene, const Plan& plan)
{
    const auto named = [](const std::string& name) {
        return name.empty() ? ordered_json() : ordered_json(name);
    };
    ordered_json json = {{"mixing_rule", mixing_rule}, {"pairs", ordered_json::array()}};
    for (const auto& pair : plan.materials) {
        json["pairs"].push_back(
            {{"materials", {named(pair.materials[0]), named(pair.materials[1])}},
             {"restitution",
              scene.contact.penalty ? ordered_json() : ordered_json(pair.restitution)},
             {"friction", pair.friction},
             {"stiffness", pair.stiffness ? ordered_json(*pair.stiffness) : ordered_json()},
             {"from", pair.listed ? "contact.pair" : "contact"}});
    }
    return json;
}

// Memory of the columns of all particles [B]: only a part of the memory of a run.
double column_bytes(const Plan& plan)
{
    double bytes = 0;
    for (const auto& field : plan.fields) {
        bytes += static_cast<double>(field.bytes());
    }
    return bytes;
}

double memory_of(const Scene& scene, const Plan& plan, const std::optional<StepCost>& timed)
{
    return memory_bytes(scene, plan, expected_course(plan, timed));
}

std::string memory_lines(const Scene& scene, const Plan& plan, const std::optional<StepCost>& timed)
{
    const double memory = memory_of(scene, plan, timed);
    std::string text =
        fmt::format("    memory                 about {} resident", readable_bytes(memory));
    if (plan.counts.fluid > 0) {
        const auto fluid = static_cast<double>(plan.counts.fluid);
        text += fmt::format(", {} per fluid particle\n{:27}of which columns {}, {} per particle",
                            readable_bytes(memory / fluid), "", readable_bytes(column_bytes(plan)),
                            readable_bytes(column_bytes(plan) / fluid));
    }
    return text + "\n";
}

std::string size_lines(const Scene& scene, const Plan& plan, const std::optional<StepCost>& timed)
{
    const auto& n = plan.counts;
    std::string text = fmt::format("  size\n    particles              {} fluid, {} wall, {} "
                                   "body\n    bodies, walls          {}, {}\n",
                                   n.fluid, n.wall, n.body, n.bodies, n.walls);
    text += memory_lines(scene, plan, timed);
    text += fmt::format("    disk                   about {}, with {:.0f} frames\n",
                        readable_bytes(disk_bytes(scene, plan, expected_course(plan, timed))),
                        plan.frames);
    if (plan.fluid) {
        text += fmt::format("    pair arithmetic        {} precision, {} instructions\n",
                            name(scene.precision), name(widest_instruction_set()));
    }
    if (scene.dimensions == 2) {
        text += "    two dimensions         masses, forces and impulses are per metre of width\n";
    }
    return text;
}

// An effect whose share is below the scatter of the timing is reported by that bound.
std::string share_text(const StepCost::Share& share)
{
    return share.share > share.spread
               ? fmt::format("{:.0f} % of a step, +- {:.0f}", 100 * share.share, 100 * share.spread)
               : fmt::format("less than {:.0f} % of a step, the scatter of the timing",
                             std::max(1.0, 100 * (share.share + share.spread)));
}

// Times measured on a busy machine are reported with an estimate for an idle one.
std::string busy_lines(const Plan& plan, const StepCost& timed)
{
    if (timed.waiting < noteworthy_waiting && timed.slowdown < noteworthy_slowdown) {
        return {};
    }
    StepCost free = timed;
    free.slowdown = 1;
    return fmt::format("      the machine was busy   threads waited for a core in {:.0f} % of the "
                       "timing,\n{:27}which made steps {:.1f} times as long: about {} on an idle "
                       "machine\n",
                       100 * timed.waiting, "", timed.slowdown,
                       readable_seconds(wall_forecast(plan, free)));
}

// A line on the fluid that enters through open sides, which makes the steps longer.
std::string entering_line(const Plan& plan, const std::optional<StepCost>& timed)
{
    if (plan.most_fluid <= plan.counts.fluid) {
        return "";
    }
    return fmt::format("      open sides           from {} to at most {} fluid particles; {}\n",
                       plan.counts.fluid, plan.most_fluid,
                       timed && timed->development ? "measured as they enter" : "mean number used");
}

std::string run_time_lines(const Plan& plan, const std::optional<StepCost>& timed)
{
    const std::string about = readable_seconds(wall_forecast(plan, timed));
    if (!plan.fluid && timed) {
        return fmt::format(
                   "    run time               about {}, at {:.3g} s per step, measured now\n",
                   about, seconds_of_run(*timed)) +
               busy_lines(plan, *timed);
    }
    if (!plan.fluid) {
        return fmt::format(
            "    run time               about {} if all bodies touch (order of magnitude)\n",
            about);
    }
    if (!timed) {
        return fmt::format("    run time               about {} on {} threads (order of magnitude; "
                           "--time measures it)\n",
                           about, thread_count()) +
               entering_line(plan, timed);
    }
    std::string text = fmt::format(
        "    run time               about {} on {} threads, at {:.3g} s per step, measured now\n",
        about, thread_count(), timed->seconds);
    text += busy_lines(plan, *timed);
    for (const StepCost::Share& share : timed->effects) {
        text += fmt::format("      {:<20} {}\n", share.effect, share_text(share));
    }
    if (timed->development) {
        const Development& d = *timed->development;
        text +=
            fmt::format("      {:<20} steps {:.2f} times as long as the first, and {:.2f} times as "
                        "many\n      {:<20} (measured at {} times the spacing, {:.1f} s)\n",
                        "development of flow", d.step, d.steps, "", d.coarsening, d.seconds);
    }
    text += entering_line(plan, timed);
    return text;
}

std::string time_lines(const Scene& scene, const Plan& plan, const std::optional<StepCost>& timed)
{
    std::string text = "  time step\n";
    if (plan.fluid) {
        text += fmt::format(
            "    speed of sound         {:.4g} m/s; largest expected speed {:.4g} m/s\n",
            plan.fluid->eos.c0, plan.expected_speed);
    }
    TimeLimit least;
    for (const TimeLimit& limit : plan.limits) {
        if (limit.name != "light body") {
            text += fmt::format("    {:<22} {:.3e} s\n", limit.name, limit.dt);
        } else if (limit.dt < least.dt) {
            least = limit;
        }
    }
    if (least.dt < infinity) {
        text += fmt::format("    {:<22} {:.3e} s\n", "lightest body", least.dt);
    }
    text +=
        fmt::format("    first step             {:.3e} s, {}\n", plan.first_step,
                    scene.time.step ? "fixed by `time.step`"
                                    : fmt::format("limited by: {}", shortest(plan.limits).name));
    text += fmt::format("    steps                  about {:.0f} until t = {} s\n",
                        expected_steps(plan, timed), scene.time.end);
    if (plan.fluid || plan.counts.bodies > 0) {
        text += run_time_lines(plan, timed);
    }
    return text;
}

// Effects, or kinds of pairs.
ordered_json reasons_json(const auto& things)
{
    ordered_json array = ordered_json::array();
    for (const auto& thing : things) {
        array.push_back({{"name", thing.name}, {"why", thing.why}});
    }
    return array;
}

ordered_json fields_json(const Plan& plan)
{
    ordered_json array = ordered_json::array();
    for (const auto& field : plan.fields) {
        array.push_back({{"name", field.name},
                         {"unit", field.unit},
                         {"bytes_per_particle", field.bytes_per_particle},
                         {"of_fluid_alone", field.of_fluid_alone},
                         {"of_solids_alone", field.of_solids_alone},
                         {"bytes", field.bytes()}});
    }
    return array;
}

ordered_json gauges_json(const Plan& plan)
{
    ordered_json list = ordered_json::array();
    for (const auto& gauge : plan.gauges) {
        list.push_back({{"name", gauge.name}, {"what", gauge.what}, {"columns", gauge.columns}});
    }
    return {{"rows", plan.gauge_rows}, {"seconds", gauge_seconds(plan)}, {"list", list}};
}

ordered_json time_step_json(const Scene& scene, const Plan& plan,
                            const std::optional<StepCost>& timed)
{
    ordered_json limits = ordered_json::array();
    for (const TimeLimit& limit : plan.limits) {
        limits.push_back({{"name", limit.name},
                          {"dt", limit.dt < infinity ? ordered_json(limit.dt) : ordered_json()}});
    }
    return {{"first", plan.first_step},
            {"limited_by", scene.time.step ? "fixed" : std::string(shortest(plan.limits).name)},
            {"steps", expected_steps(plan, timed)},
            {"limits", limits}};
}

ordered_json forecast_json(const Scene& scene, const Plan& plan,
                           const std::optional<StepCost>& timed, int processes)
{
    const double memory = memory_of(scene, plan, timed);
    const auto fluid = static_cast<double>(plan.counts.fluid);
    return {{"memory_bytes", memory},
            {"memory_bytes_per_fluid_particle",
             fluid > 0 ? ordered_json(memory / fluid) : ordered_json()},
            {"column_bytes", column_bytes(plan)},
            {"frames", plan.frames},
            {"disk_bytes", disk_bytes(scene, plan, expected_course(plan, timed))},
            {"disk_bytes_uncompressed", plan.frames * plan.frame_bytes},
            {"processes", processes},
            {"wall_seconds", wall_forecast(plan, timed, processes)}};
}

} // namespace

std::string readable_bytes(double bytes)
{
    constexpr const char* units[] = {"B", "kB", "MB", "GB", "TB"};
    int unit = 0;
    while (bytes >= 1000 && unit < 4) {
        bytes /= 1000;
        ++unit;
    }
    return fmt::format("{:.3g} {}", bytes, units[unit]);
}

std::string readable_seconds(double seconds)
{
    if (seconds < 60) {
        return fmt::format("{:.0f} s", seconds);
    }
    const auto whole = std::llround(seconds);
    return whole < 3600 ? fmt::format("{} min {:02} s", whole / 60, whole % 60)
                        : fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::string plan_text(const Scene& scene, const Plan& plan, const std::optional<StepCost>& timed)
{
    std::string text = fmt::format("plan of \"{}\"\n  on\n{}  off\n{}", scene.title,
                                   join_effects(plan.on), join_effects(plan.off));
    if (!plan.pair_kinds.empty()) {
        text += "  pair kinds\n";
        for (const auto& kind : plan.pair_kinds) {
            text += fmt::format("    {:<22} {}\n", kind.name, kind.why);
        }
    }
    if (!plan.fields.empty()) {
        text += "  fields\n";
        std::size_t of_fluid = 0, of_solids = 0;
        for (const auto& field : plan.fields) {
            text += fmt::format("    {:<22} {:<8} {:>3} B{}\n", field.name, field.unit,
                                field.bytes_per_particle, field.holders());
            of_fluid += field.of_solids_alone ? 0 : field.bytes_per_particle;
            of_solids += field.of_fluid_alone ? 0 : field.bytes_per_particle;
        }
        text +=
            fmt::format("    {:<22} {:<8} {:>3} B per fluid particle, {} B per solid particle\n",
                        "together", "", of_fluid, of_solids);
    }
    return text + material_lines(scene, plan) + gauge_lines(scene, plan) + open_lines(plan) +
           scale_lines(plan) + size_lines(scene, plan, timed) + time_lines(scene, plan, timed);
}

std::string plan_json(const Scene& scene, const Plan& plan, const std::optional<StepCost>& timed,
                      int processes)
{
    ordered_json json;
    json["title"] = scene.title;
    json["dimensions"] = scene.dimensions;
    json["on"] = reasons_json(plan.on);
    json["off"] = reasons_json(plan.off);
    json["fields"] = fields_json(plan);
    json["pair_kinds"] = reasons_json(plan.pair_kinds);
    if (plan.contact) {
        json["contact"] = material_json(scene, plan);
    }
    if (!plan.gauges.empty()) {
        json["gauges"] = gauges_json(plan);
    }
    if (!plan.open.empty()) {
        json["open"] = {{"most_fluid", plan.most_fluid}, {"sides", ordered_json::array()}};
        for (const auto& open : plan.open) {
            json["open"]["sides"].push_back(
                {{"name", open.name}, {"what", open.what}, {"carpet", open.carpet}});
        }
    }
    const auto& n = plan.counts;
    json["counts"] = {{"fluid", n.fluid},
                      {"wall", n.wall},
                      {"body", n.body},
                      {"bodies", n.bodies},
                      {"walls", n.walls}};
    json["time_step"] = time_step_json(scene, plan, timed);
    if (plan.fluid) {
        json["sound_speed"] = plan.fluid->eos.c0;
        json["expected_speed"] = plan.expected_speed;
        json["precision"] = name(scene.precision);
        json["instruction_set"] = name(widest_instruction_set());
    }
    add_scale(plan, json);
    json["forecast"] = forecast_json(scene, plan, timed, processes);
    if (timed) {
        json["cost"] = cost_json(*timed);
    }
    json["warnings"] = ordered_json::array();
    for (const Diagnostic& warning : plan.warnings) {
        json["warnings"].push_back(to_string(warning));
    }
    return json.dump(2) + "\n";
}

} // namespace hyoryu
