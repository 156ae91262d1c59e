// SPDX-License-Identifier: MIT
#include "cost_report.hpp"

#include "stop_request.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/input_file.hpp"
#include "hyoryu/core/parallel.hpp"
#include "hyoryu/io/results.hpp"
#include "hyoryu/scene/case_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <fstream>

namespace hyoryu {

namespace {

using nlohmann::ordered_json;

constexpr double part_of_run = 0.01;
constexpr double part_that_is_early = 0.05;
constexpr double part_of_short_run = 0.05;
constexpr double least_steps = 15; // some with new lists among them
constexpr double most_steps = 60;  // more steps would not be more accurate
constexpr double shortest_run = 100;

ordered_json read(const std::filesystem::path& file)
{
    ordered_json value = why_unreadable(file).empty()
                             ? ordered_json::parse(bytes_of_file(file), nullptr, false)
                             : ordered_json();
    if (!value.is_object()) {
        throw IoError(fmt::format("{} is missing or damaged, so the cost of the run is unknown",
                                  file.string()));
    }
    return value;
}

ordered_json value_at(const ordered_json& json, const std::string& pointer)
{
    const ordered_json::json_pointer place(pointer);
    return json.contains(place) ? json.at(place) : ordered_json();
}

// The share of an effect, or its spread; null if it was not timed apart.
ordered_json measured_share(const std::optional<StepCost>& measured, const std::string& effect,
                            double StepCost::Share::*number)
{
    if (measured) {
        const auto found = std::ranges::find(measured->effects, effect, &StepCost::Share::effect);
        if (found != measured->effects.end()) {
            return (*found).*number;
        }
    }
    return {};
}

// Bytes for each particle of the fluid that the run began with; null without fluid.
ordered_json per_fluid_particle(const ordered_json& bytes, const ordered_json& plan)
{
    const ordered_json fluid = value_at(plan, "/counts/fluid");
    const bool told = bytes.is_number() && fluid.is_number() && fluid.get<double>() > 0;
    return told ? ordered_json(bytes.get<double>() / fluid.get<double>()) : ordered_json();
}

// Limits cases with few particles to one thread: otherwise the number of threads of a loop would
// change as the water spreads, and the time to wake threads would distort the development of the
// work.
class ThreadsFor {
public:
    explicit ThreadsFor(Index particles) : before_(thread_count())
    {
        constexpr Index few = 4 * worth_sharing_rows;
        set_threads(particles < few ? 1 : before_);
    }
    ~ThreadsFor() { set_threads(before_); }
    ThreadsFor(const ThreadsFor&) = delete;
    ThreadsFor& operator=(const ThreadsFor&) = delete;

private:
    int before_;
};

// Runs the case at a multiple of its spacing; nothing if that takes more than `seconds`.
std::optional<Development> develop(const CaseSource& source, const Plan& plan, double coarsening,
                                   int first, double seconds_of_step, double most_seconds)
{
    std::vector<std::string> overrides = source.overrides;
    overrides.push_back(fmt::format("particles.spacing={}", coarsening * plan.fluid->spacing));
    const Scene scene = read_case(source.file, overrides);
    const Filling filling = fill(scene);
    const Plan coarse = make_plan(scene, filling);
    const double of_particles =
        static_cast<double>(coarse.counts.fluid) / static_cast<double>(plan.counts.fluid);
    if (coarse.expected_steps * seconds_of_step * of_particles > most_seconds) {
        return {};
    }
    const ThreadsFor threads(coarse.counts.fluid);
    Simulation sim = make_simulation(scene, coarse, filling);
    Simulation again = make_simulation(scene, coarse, filling);
    // Small scenes have steps of a few microseconds, so that more of them must be timed.
    first = std::max(first, static_cast<int>(part_that_is_early * coarse.expected_steps));
    using Wall = std::chrono::steady_clock;
    const auto end = Wall::now() + std::chrono::duration<double>(3 * most_seconds);
    std::optional<Development> found = measure_development(
        sim, again, first, [&] { return Wall::now() < end && !stop_requested(); });
    if (found) {
        found->coarsening = coarsening;
    }
    return found;
}

} // namespace

double bytes_in(const std::filesystem::path& folder)
{
    namespace fs = std::filesystem;
    double total = 0;
    std::error_code fault; // unreadable files count as empty
    const fs::recursive_directory_iterator end;
    for (fs::recursive_directory_iterator at(folder, fault); !fault && at != end;
         at.increment(fault)) {
        std::error_code not_a_file;
        const std::uintmax_t size = fs::file_size(at->path(), not_a_file);
        total += not_a_file ? 0 : static_cast<double>(size);
    }
    return total;
}

void predict_development(const CaseSource& source, const Plan& plan, int first, double most_seconds,
                         StepCost& cost)
{
    for (const double coarsening : {2.0, 3.0, 4.0}) {
        try {
            cost.development = develop(source, plan, coarsening, first, cost.seconds, most_seconds);
        } catch (const CaseError&) {
            return; // the case cannot be represented with so few particles
        }
        if (cost.development) {
            cost.slowdown = cost.development->slowdown; // of more steps
            return;
        }
    }
}

int steps_to_time(const Plan& plan, double steps)
{
    const double least = std::min(part_of_short_run * steps, least_steps);
    const double few = std::clamp(part_of_run * steps, least, most_steps);
    return plan.fluid && steps >= shortest_run ? static_cast<int>(few) : 0;
}

std::optional<StepCost> time_steps(Simulation& sim, int steps)
{
    if (steps == 0) {
        return {};
    }
    try {
        return measure_cost(sim, steps);
    } catch (const NumericalError&) {
        return {};
    }
}

void write_cost(const std::filesystem::path& folder, const SpentCost& spent,
                const std::optional<StepCost>& measured)
{
    const ordered_json plan = read(folder / "plan.json");
    ordered_json summary = read(folder / "summary.json");
    summary["peak_memory_bytes"] = spent.memory; // results.h5 included
    ordered_json& cost = summary["cost"];
    const auto add = [&](const char* name, const char* predicted, const ordered_json& told) {
        cost[name] = {{"predicted", value_at(plan, predicted)}, {"measured", told}};
    };
    add("seconds_per_step", "/cost/seconds_per_step",
        spent.steps > 0 ? spent.wall_seconds / spent.steps : 0);
    add("steps", "/time_step/steps", value_at(summary, "/steps"));
    add("memory_bytes", "/forecast/memory_bytes", value_at(summary, "/peak_memory_bytes"));
    cost["memory_bytes_per_fluid_particle"] = {
        {"predicted", per_fluid_particle(cost["memory_bytes"]["predicted"], plan)},
        {"measured", per_fluid_particle(cost["memory_bytes"]["measured"], plan)},
        {"of_it_columns", per_fluid_particle(value_at(plan, "/forecast/column_bytes"), plan)}};
    add("disk_bytes", "/forecast/disk_bytes", bytes_in(folder));
    add("wall_seconds", "/forecast/wall_seconds", spent.wall_seconds);
    add("waiting_for_a_core", "/cost/waiting_for_a_core", spent.waiting);
    cost["effects"] = ordered_json::array();
    for (const ordered_json& effect : value_at(plan, "/on")) {
        const std::string name = effect.value("name", "");
        cost["effects"].push_back(
            {{"name", name},
             {"asked", value_at(effect, "/why")},
             {"predicted", value_at(plan, "/cost/effects/" + name)},
             {"predicted_spread", value_at(plan, "/cost/effects_spread/" + name)},
             {"measured", measured_share(measured, name, &StepCost::Share::share)},
             {"measured_spread", measured_share(measured, name, &StepCost::Share::spread)}});
    }
    write_text(folder / "summary.json", summary.dump(2) + "\n");
}

} // namespace hyoryu
