// SPDX-License-Identifier: MIT
#include "hyoryu/sim/cost.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/sim/watch.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <span>
#include <string_view>

namespace hyoryu {

namespace {

constexpr int least_rounds = 2;

struct Variant {
    std::string without; // effect; none in the first
    FluidEffects effects;
    std::vector<double> seconds = {}; // of the step of each round, without making lists
};

// The effects as they are, then without each that runs.
std::vector<Variant> variants(const Simulation& sim)
{
    std::vector<Variant> all{{"", sim.plan.effects}};
    const auto add = [&](std::string_view name, auto slot) {
        if (sim.plan.runs(name)) {
            FluidEffects& effects =
                all.emplace_back(Variant{std::string(name), sim.plan.effects}).effects;
            effects[slot] = Off{};
            if (std::holds_alternative<Off>(effects[slot::viscosity])) {
                effects[slot::slip] = Off{}; // it is viscosity at solids
            }
        }
    };
    for_each(ModelSlots<AllSlots>{}, [&](auto slot) {
        const auto add_model = [&]<class Model>(const Model&) {
            if constexpr (!std::is_same_v<Model, Off>) {
                add(Model::name, slot);
            }
        };
        std::visit(add_model, sim.scene.fluid->effects[slot]);
    });
    add(NoSlip::name, slot::slip);
    add(CorrectedGradient::name, slot::gradient);
    return all;
}

// Of the stages so far [s].
struct Spent {
    double bodies = 0;
    double lists = 0;
    double all_else = 0;
};
Spent spent(const Simulation& sim)
{
    Spent total;
    for (const StageTimer::Stage& stage : sim.timer.stages()) {
        double& part = stage.name == "bodies"       ? total.bodies
                       : stage.name == "neighbours" ? total.lists
                                                    : total.all_else;
        part += stage.seconds;
    }
    return total;
}

// The mean cost of a step since `before`.
Spent spent_since(const Spent& before, const Simulation& sim, double steps)
{
    const Spent now = spent(sim);
    return {(now.bodies - before.bodies) / steps, (now.lists - before.lists) / steps,
            (now.all_else - before.all_else) / steps};
}

double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double impacts_of_step(const Simulation& sim)
{
    return static_cast<double>(
        std::ranges::count(sim.contacts, Contact::Kind::impact, &Contact::kind));
}

double sum(std::span<const double> values)
{
    return std::accumulate(values.begin(), values.end(), 0.0);
}

// How the fluid of a simulation and its impacts went by.
struct Passed {
    double fluid_time = 0; // particles times seconds
    double impacts = 0;
};

void count_step(Simulation& sim, Passed& passed)
{
    const double before = sim.clock.time;
    step(sim);
    passed.impacts += impacts_of_step(sim);
    passed.fluid_time +=
        static_cast<double>(sim.fluid->particles.fluid.size()) * (sim.clock.time - before);
}

// No frame cuts a step short.
void cut_no_step(Simulation& sim)
{
    sim.scene.output.every = infinity;
    sim.clock.frame = 1;
}

// Mean of a number of steps after the first one, without bodies and lists.
double early_step(Simulation& sim, int first)
{
    cut_no_step(sim);
    step(sim);
    const Spent before = spent(sim);
    for (int k = 0; k < first; ++k) {
        step(sim);
    }
    return spent_since(before, sim, first).all_else;
}

// Of making lists, in a fluid that has lists.
double seconds_of_build(Fluid& fluid)
{
    constexpr int builds = 3;
    double least = infinity;
    for (int k = 0; k < builds; ++k) {
        const auto start = std::chrono::steady_clock::now();
        fluid.neighbours.builds = 0; // as at the start: they are made whatever has moved
        update_neighbours(fluid);
        least = std::min(least, seconds_since(start));
    }
    return least;
}

// The cost of the effect that a variant leaves out, one value a round [1].
std::vector<double> shares(const Variant& with, const Variant& without, const Spent& of_step)
{
    std::vector<double> found;
    for (std::size_t round = 0; round < with.seconds.size(); ++round) {
        found.push_back((with.seconds[round] - without.seconds[round]) /
                        (with.seconds[round] + of_step.lists));
    }
    return found;
}

double seconds_of_step(Simulation& sim)
{
    const auto start = std::chrono::steady_clock::now();
    step(sim);
    return seconds_since(start);
}

} // namespace

StepCost::Share share_of(std::string effect, std::vector<double> rounds)
{
    expects(!rounds.empty());
    std::ranges::sort(rounds);
    // Between the two nearest by rank: all rounds count where there are few.
    const auto at = [&](double rank) {
        const double place = rank * static_cast<double>(rounds.size() - 1);
        const auto below = static_cast<std::size_t>(place);
        const std::size_t above = std::min(below + 1, rounds.size() - 1);
        return rounds[below] +
               (place - static_cast<double>(below)) * (rounds[above] - rounds[below]);
    };
    const bool few = rounds.size() < 4;
    const double half = 0.5 * (few ? at(1) - at(0) : at(0.75) - at(0.25));
    const double median = at(0.5);
    return {std::move(effect), std::max(median, 0.0), std::max(half, -median)};
}

double seconds_of_run(const StepCost& cost)
{
    if (!cost.development) {
        return cost.seconds + cost.output;
    }
    const Development& over = *cost.development;
    return over.step * (cost.seconds - cost.bodies - cost.lists) + over.builds * cost.build +
           cost.bodies + cost.output;
}

double measure_row(const Simulation& sim)
{
    constexpr int looks = 2;
    double least = infinity;
    for (int k = 0; k < looks; ++k) {
        const auto start = std::chrono::steady_clock::now();
        const Totals now = totals(sim);
        watch_energy(sim, now);
        static_cast<void>(totals(sim));
        least = std::min(least, seconds_since(start));
    }
    return least;
}

StepCost measure_cost(Simulation& sim, int steps)
{
    // Neither the end nor a frame may cut a step short.
    sim.scene.time.end = infinity;
    cut_no_step(sim);
    std::vector<Variant> all = variants(sim);
    const int rounds = std::max(least_rounds, steps / static_cast<int>(all.size()));
    step(sim); // warms the caches
    StepCost cost;
    const Spent start = spent(sim);
    const long long builds_before = sim.fluid->neighbours.builds;
    for (int round = 0; round < rounds; ++round) {
        for (Variant& variant : all) {
            sim.fluid->effects = variant.effects;
            const double lists = spent(sim).lists;
            const double seconds = seconds_of_step(sim);
            variant.seconds.push_back(seconds - (spent(sim).lists - lists));
            if (variant.without.empty()) {
                cost.seconds += variant.seconds.back() / rounds;
            }
        }
    }
    // Lists are constructed in some steps only: their frequency is the mean over all steps.
    const double timed = rounds * static_cast<double>(all.size());
    const Spent of_all = spent_since(start, sim, timed);
    cost.seconds += of_all.lists;
    cost.bodies = of_all.bodies;
    const auto builds = static_cast<double>(sim.fluid->neighbours.builds - builds_before) / timed;
    cost.build = seconds_of_build(*sim.fluid);
    cost.lists = std::min(builds * cost.build, of_all.lists);
    for (const Variant& variant : all) {
        if (!variant.without.empty()) {
            cost.effects.push_back(share_of(variant.without, shares(all.front(), variant, of_all)));
        }
    }
    return cost;
}

double steady_seconds()
{
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(now).count();
}

std::optional<StepCost> measure_bodies(Simulation& sim, const std::function<bool()>& goes_on,
                                       const Stopwatch& now)
{
    constexpr double grows = 1.3; // more than noise makes of two halves alike
    cut_no_step(sim);
    std::vector<double> steps; // seconds of each
    StepCost cost;
    try {
        while (!finished(sim.clock, sim.scene) && goes_on()) {
            const double start = now();
            step(sim);
            steps.push_back(now() - start);
            cost.impacts += impacts_of_step(sim);
        }
    } catch (const NumericalError&) {
        return {};
    }
    const std::span<const double> all(steps);
    const std::size_t half = all.size() / 2;
    const bool done = finished(sim.clock, sim.scene);
    if (half == 0 || (!done && sum(all.last(half)) > grows * sum(all.first(half)))) {
        return {};
    }
    const auto count = static_cast<double>(all.size());
    cost.seconds = cost.bodies = sum(all) / count;
    cost.impacts *= done ? 1 : std::max(1.0, sim.plan.expected_steps / count);
    return cost;
}

std::optional<Development> measure_development(Simulation& sim, Simulation& again, int first,
                                               const std::function<bool()>& goes_on)
{
    const auto start = std::chrono::steady_clock::now();
    const auto particles = static_cast<double>(sim.fluid->particles.fluid.size());
    cut_no_step(sim);
    Passed passed;
    try {
        count_step(sim, passed);
        const Spent before = spent(sim);
        while (!finished(sim.clock, sim.scene)) {
            if (!goes_on()) {
                return {};
            }
            count_step(sim, passed);
        }
        const auto steps = static_cast<double>(sim.clock.step);
        if (steps <= first) {
            return {};
        }
        const double late = spent_since(before, sim, steps - 1).all_else;
        const double early = early_step(again, first);
        if (!(early > 0)) {
            return {};
        }
        const auto left = static_cast<double>(sim.fluid->particles.fluid.size());
        return Development{.steps = steps / sim.plan.expected_steps,
                           .step = late / early,
                           .builds = static_cast<double>(sim.fluid->neighbours.builds) / steps,
                           .seconds = seconds_since(start),
                           .fluid = passed.fluid_time / (particles * sim.clock.time),
                           .fluid_end = left / particles,
                           .impacts = passed.impacts};
    } catch (const NumericalError&) {
        return {};
    }
}

} // namespace hyoryu
