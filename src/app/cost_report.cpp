// SPDX-License-Identifier: MIT
#include "cost_report.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/io/results.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace hyoryu {

namespace {

using nlohmann::ordered_json;

constexpr double part_of_run = 0.005;
constexpr int least_steps = 5; // two rounds and the step before them cost no less
constexpr int most_steps = 60; // more would tell no more

ordered_json read(const std::filesystem::path& file)
{
    std::ifstream stream(file);
    return ordered_json::parse(stream);
}

ordered_json value_at(const ordered_json& json, const std::string& pointer)
{
    const ordered_json::json_pointer place(pointer);
    return json.contains(place) ? json.at(place) : ordered_json();
}

ordered_json measured_share(const std::optional<StepCost>& measured, const std::string& effect)
{
    if (measured) {
        const auto found = std::ranges::find(measured->effects, effect, &StepCost::Share::effect);
        if (found != measured->effects.end()) {
            return found->share;
        }
    }
    return {};
}

} // namespace

int steps_to_time(const Plan& plan, double steps)
{
    const double few = part_of_run * steps;
    return plan.fluid && few >= least_steps ? static_cast<int>(std::min<double>(few, most_steps))
                                            : 0;
}

std::optional<StepCost> time_steps(Simulation&& sim, int steps)
{
    if (steps == 0) {
        return {};
    }
    try {
        return measure_cost(std::move(sim), steps);
    } catch (const NumericalError&) {
        return {};
    }
}

void write_cost(const std::filesystem::path& folder, double seconds_per_step,
                const std::optional<StepCost>& measured)
{
    const ordered_json plan = read(folder / "plan.json");
    ordered_json summary = read(folder / "summary.json");
    ordered_json& cost = summary["cost"];
    cost["seconds_per_step"] = {{"predicted", value_at(plan, "/cost/seconds_per_step")},
                                {"measured", seconds_per_step}};
    cost["steps"] = {{"predicted", value_at(plan, "/time_step/steps")},
                     {"measured", summary.at("steps")}};
    cost["memory_bytes"] = {{"predicted", value_at(plan, "/forecast/memory_bytes")},
                            {"measured", summary.at("peak_memory_bytes")}};
    cost["effects"] = ordered_json::array();
    for (const ordered_json& effect : plan.at("on")) {
        const auto name = effect.at("name").get<std::string>();
        cost["effects"].push_back({{"name", name},
                                   {"asked", effect.at("why")},
                                   {"predicted", value_at(plan, "/cost/effects/" + name)},
                                   {"measured", measured_share(measured, name)}});
    }
    write_text(folder / "summary.json", summary.dump(2) + "\n");
}

} // namespace hyoryu
