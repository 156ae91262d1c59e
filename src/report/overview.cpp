// SPDX-License-Identifier: MIT
// The sections of text and tables: case, plan, run, cost.
#include "hyoryu/report/html.hpp"
#include "hyoryu/report/table.hpp"
#include "sections.hpp"

#include <fmt/format.h>

#include <cmath>

namespace hyoryu {

namespace {

using nlohmann::ordered_json;
using Align = TextTable::Align;

std::string effect_table(const ordered_json& effects)
{
    TextTable table{.heads = {{"effect"}, {"why"}}, .rows = {}};
    for (const ordered_json& effect : effects) {
        table.rows.push_back(
            {effect.at("name").get<std::string>(), effect.at("why").get<std::string>()});
    }
    return html_table(table);
}

std::string wall_names(const RunResults& run)
{
    std::string names;
    for (const std::string& wall : run.walls) {
        const std::string& material = run.contact.materials.at(wall);
        names += (names.empty() ? "" : ", ") + wall;
        names += material.empty() ? "" : fmt::format(" ({})", material);
    }
    return names.empty() ? "none" : names;
}

std::string closing_state(const std::string& exit_reason)
{
    return exit_reason == "done" ? "done: the run reached the end of the case" : exit_reason;
}

std::string counted(const ordered_json& counts)
{
    return fmt::format("{} fluid, {} wall, {} body", counts.at("fluid").get<std::int64_t>(),
                       counts.at("wall").get<std::int64_t>(),
                       counts.at("body").get<std::int64_t>());
}

/// A table of two columns: names and their values.
std::string facts(std::vector<std::vector<std::string>> rows)
{
    return html_table({.heads = {{"quantity"}, {"value"}}, .rows = std::move(rows)});
}

/// The consequences of the resolution at the scale of the scene, for a run with fluid.
std::string scale_table(const RunResults& run)
{
    if (!run.plan.contains("scale")) {
        return {};
    }
    const ordered_json& scale = run.plan.at("scale");
    const auto number = [&](const char* key) {
        return scale.at(key).is_number() ? readable(scale.at(key).get<double>()) : "–";
    };
    std::string absent;
    for (const ordered_json& one : scale.at("absent")) {
        absent += (absent.empty() ? "" : "; ") + one.get<std::string>();
    }
    return facts({{"depth of the water at the start [m]", number("depth")},
                  {"the same in spacings", number("depth_in_spacings")},
                  {"shortest load resolved, 4 spacings / c0 [s]", number("shortest_load")},
                  {"viscosity of the scheme [m2/s]", number("viscosity")},
                  {"effective Reynolds number u d/nu", number("reynolds")},
                  {"absent", absent}});
}

} // namespace

std::string readable(double value)
{
    return std::isfinite(value) ? fmt::format("{:.4g}", value) : "–";
}

std::string case_section(const RunResults& run)
{
    const ordered_json& counts = run.plan.at("counts");
    std::string text = "<h2>Case</h2>\n";
    text +=
        facts({{"title", run.plan.at("title").get<std::string>()},
               {"dimensions", run.dimensions() == 2
                                  ? "2 (x-z plane); masses, forces and impulses per metre of width"
                                  : "3"},
               {"walls", wall_names(run)},
               {"bodies", fmt::format("{}", counts.at("bodies").get<std::int64_t>())},
               {"particles at the start", counted(counts)},
               {"particle spacing [m]", readable(run.spacing)}});
    return text + scale_table(run) +
           "<details><summary>The resolved case, with all defaults</summary>\n"
           "<pre>" +
           escaped(run.case_text) + "</pre></details>\n";
}

std::string plan_section(const RunResults& run)
{
    std::string text = "<h2>Plan</h2>\n<h3>Effects that ran</h3>\n";
    text += effect_table(run.plan.at("on"));
    text += "<h3>Effects that did not run</h3>\n" + effect_table(run.plan.at("off"));
    if (const ordered_json& warnings = run.plan.at("warnings"); !warnings.empty()) {
        text += "<h3>Warnings before the run</h3>\n";
        for (const ordered_json& warning : warnings) {
            text += fmt::format("<pre>{}</pre>\n", escaped(warning.get<std::string>()));
        }
    }
    return text;
}

std::string run_section(const RunResults& run)
{
    const ordered_json& s = run.summary;
    const double simulated = number(s.at("simulated_seconds"));
    const double steps = number(s.at("steps"));
    return "<h2>Run</h2>\n" +
           facts(
               {{"exit reason", closing_state(s.at("exit_reason").get<std::string>())},
                {"simulated time [s]", readable(simulated)},
                {"steps", fmt::format("{:.0f}", steps)},
                {"mean time step [s]", readable(simulated / steps)},
                {"wall time [s]", readable(number(s.at("wall_seconds")))},
                {"threads", fmt::format("{}", s.at("threads").get<int>())},
                {"particles at the end", counted(s.at("counts"))},
                {"fluid particles lost", fmt::format("{:.0f}", number(s.at("particles_lost")))},
                {"worst density error", readable(number(s.at("worst_density_error")))},
                {"program", fmt::format("hyoryu {}, commit {}", s.at("version").get<std::string>(),
                                        s.at("commit").get<std::string>())}});
}

// Whether other work held the cores.
std::string busy_text(const ordered_json& cost)
{
    constexpr double noteworthy = 0.05;
    if (!cost.contains("waiting_for_a_core")) {
        return {};
    }
    const double waiting = number(cost.at("waiting_for_a_core").at("measured"));
    return waiting > noteworthy ? fmt::format(" The machine was busy: threads waited for a core in "
                                              "{:.0f} % of the run.",
                                              100 * waiting)
                                : std::string();
}

// Predicted and measured cost; absent for runs that did not reach their end.
std::string forecast_table(const RunResults& run)
{
    if (!run.summary.contains("cost")) {
        return {};
    }
    const ordered_json& cost = run.summary.at("cost");
    TextTable table{
        .heads = {{"effect"}, {"reason"}, {"predicted", Align::right}, {"measured", Align::right}},
        .rows = {}};
    const auto cell = [](const ordered_json& value, double factor, const char* unit) {
        return value.is_number() ? readable(factor * value.get<double>()) + unit : std::string();
    };
    const auto cell_of = [&](const ordered_json& values, const std::string& key, double factor,
                             const char* unit) {
        const std::string spread = key + "_spread";
        const bool scatters = values.contains(spread) && values.at(spread).is_number();
        return cell(values.at(key), factor, unit) +
               (scatters ? " ± " + cell(values.at(spread), factor, unit) : std::string());
    };
    const auto add = [&](const std::string& name, const std::string& why,
                         const ordered_json& values, double factor, const char* unit) {
        table.rows.push_back({name, why, cell_of(values, "predicted", factor, unit),
                              cell_of(values, "measured", factor, unit)});
    };
    add("a step", "wall time", cost.at("seconds_per_step"), 1e3, " ms");
    add("steps", "", cost.at("steps"), 1, "");
    add("memory", "peak resident", cost.at("memory_bytes"), 1e-6, " MB");
    if (cost.contains("memory_bytes_per_fluid_particle")) {
        add("memory", "per fluid particle", cost.at("memory_bytes_per_fluid_particle"), 1, " B");
    }
    if (cost.contains("disk_bytes")) {
        add("disk", "all results", cost.at("disk_bytes"), 1e-6, " MB");
    }
    for (const ordered_json& effect : cost.at("effects")) {
        add(effect.at("name").get<std::string>(), effect.at("asked").get<std::string>(), effect,
            100, " %");
    }
    return "<h2>Predicted and measured cost</h2>\n" + html_table(table) +
           html_paragraph(
               "The share of an effect is the additional time of a step with it, measured at the "
               "start and at the end of the run, with half of the interquartile range of the "
               "timings; effects without a number are not timed separately." +
               busy_text(cost));
}

std::string cost_section(const RunResults& run)
{
    const double wall = number(run.summary.at("wall_seconds"));
    TextTable table{
        .heads = {{"stage"}, {"time [s]", Align::right}, {"share of wall time", Align::right}},
        .rows = {}};
    const auto add = [&](const std::string& stage, double seconds) {
        table.rows.push_back(
            {stage, readable(seconds), fmt::format("{:.1f} %", 100 * seconds / wall)});
    };
    double rest = wall;
    for (const auto& [stage, seconds] : run.summary.at("stages").items()) {
        add(stage, number(seconds));
        rest -= number(seconds);
    }
    add("remaining time, mostly output", rest);
    add("together", wall);
    return "<h2>Cost by stage</h2>\n" + html_table(table) +
           html_paragraph(
               fmt::format("{} particle-steps per second; peak memory {} MB.",
                           readable(number(run.summary.at("particle_steps_per_second"))),
                           readable(1e-6 * number(run.summary.at("peak_memory_bytes"))))) +
           forecast_table(run);
}

} // namespace hyoryu
