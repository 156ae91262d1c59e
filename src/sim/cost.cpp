// SPDX-License-Identifier: MIT
#include "hyoryu/sim/cost.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/timer.hpp"
#include "hyoryu/sim/watch.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <string_view>

namespace hyoryu {

namespace {

constexpr int least_rounds = 2;
// Short steps are timed for this time at least, with up to `most_rounds` times the steps asked for,
// since other work occupies a core for some milliseconds at a time.
constexpr double shortest_timing = 0.05; // [s]
constexpr int most_rounds = 4;

struct Variant {
    std::string without; // effect; none in the first
    FluidEffects effects;
    std::vector<double> seconds = {}; // of the step of each round, without making lists
};

// All effects, then for each effect that runs all others.
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
    add(PairedWalls::name, slot::wall_continuity);
    return all;
}

// Time spent in the stages so far [s].
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

double total(std::span<const double> values)
{
    return std::accumulate(values.begin(), values.end(), 0.0);
}

// The stages of steps, one value a step [s].
class StepTimes {
public:
    explicit StepTimes(const Simulation& sim) : last_(spent(sim)) {}

    void add(const Simulation& sim)
    {
        const Spent now = spent(sim);
        bodies_ += now.bodies - last_.bodies;
        lists_ += now.lists - last_.lists;
        all_else_.push_back(now.all_else - last_.all_else);
        last_ = now;
    }
    /// Leaves a step out.
    void skip(const Simulation& sim) { last_ = spent(sim); }
    /// The mean of a step, without stalls except those in list making. Bodies meet in some steps
    /// only, so that no median separates them from stalls: their time is divided by the slowdown of
    /// the rest.
    Spent mean() const
    {
        const auto count = static_cast<double>(all_else_.size());
        return {bodies_ / (count * slowdown()), lists_ / count, mean_without_stalls(all_else_)};
    }
    /// All but bodies and lists over the same without stalls.
    double slowdown() const
    {
        const double free = static_cast<double>(all_else_.size()) * mean_without_stalls(all_else_);
        return free > 0 ? std::max(total(all_else_) / free, 1.0) : 1.0;
    }

private:
    Spent last_;
    double bodies_ = 0;
    double lists_ = 0;
    std::vector<double> all_else_;
};

double impacts_of_step(const Simulation& sim)
{
    return static_cast<double>(
        std::ranges::count(sim.contacts, Contact::Kind::impact, &Contact::kind));
}

// Sums over the steps of a simulation: fluid particles times time, and impacts.
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

// The first steps of a scene, some at a time between those of its whole run, so that other work of
// the machine lengthens both alike.
class EarlySteps {
public:
    EarlySteps(Simulation& sim, int steps, double of_run)
        : sim_(sim), times_(sim), groups_(std::max(1, steps / group)), every_(of_run / groups_)
    {
        cut_no_step(sim_);
    }
    /// Takes some early steps if they are due after `run` steps of the run.
    void follow(double run)
    {
        if (done_ < groups_ && run >= (done_ + 0.5) * every_) {
            take();
        }
    }
    /// The mean of a step, without bodies, lists and stalls.
    double mean()
    {
        while (done_ < groups_) {
            take();
        }
        return times_.mean().all_else;
    }

private:
    void take()
    {
        step(sim_); // warms the caches
        times_.skip(sim_);
        for (int k = 0; k < group; ++k) {
            step(sim_);
            times_.add(sim_);
        }
        ++done_;
    }

    static constexpr int group = 5;
    Simulation& sim_;
    StepTimes times_;
    int groups_;
    double every_; // steps of the run
    int done_ = 0;
};

// Time to make the lists of a fluid once; the fluid must have lists.
double seconds_of_build(Fluid& fluid)
{
    constexpr int builds = 3;
    double least = infinity;
    for (int k = 0; k < builds; ++k) {
        const double start = steady_seconds();
        fluid.neighbours.builds = 0; // as at the start: they are made whatever has moved
        update_neighbours(fluid);
        least = std::min(least, steady_seconds() - start);
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

double mean_without_stalls(std::span<const double> seconds)
{
    constexpr std::size_t longest = 15; // a run of steps
    if (seconds.empty()) {
        return 0;
    }
    const std::size_t runs = (seconds.size() + longest - 1) / longest;
    double total = 0;
    for (std::size_t k = 0; k < runs; ++k) {
        const std::size_t first = k * seconds.size() / runs;
        const std::size_t last = (k + 1) * seconds.size() / runs;
        std::vector<double> run(seconds.begin() + static_cast<std::ptrdiff_t>(first),
                                seconds.begin() + static_cast<std::ptrdiff_t>(last));
        std::ranges::sort(run);
        const double median = (run[(run.size() - 1) / 2] + run[run.size() / 2]) / 2;
        total += median * static_cast<double>(run.size());
    }
    return total / static_cast<double>(seconds.size());
}

double seconds_of_run(const StepCost& cost)
{
    if (!cost.development) {
        return cost.slowdown * cost.seconds + cost.output;
    }
    const Development& over = *cost.development;
    const double step = over.step * (cost.seconds - cost.bodies - cost.lists) +
                        over.builds * cost.build + cost.bodies;
    return cost.slowdown * step + cost.output;
}

double measure_row(const Simulation& sim)
{
    constexpr int looks = 2;
    double least = infinity;
    for (int k = 0; k < looks; ++k) {
        const double start = steady_seconds();
        const Totals now = totals(sim);
        watch_energy(sim, now);
        static_cast<void>(totals(sim));
        least = std::min(least, steady_seconds() - start);
    }
    return least;
}

StepCost measure_cost(Simulation& sim, int steps)
{
    // Neither the end nor a frame may cut a step short.
    sim.scene.time.end = infinity;
    cut_no_step(sim);
    std::vector<Variant> all = variants(sim);
    const int asked = std::max(least_rounds, steps / static_cast<int>(all.size()));
    step(sim); // warms the caches
    StepCost cost;
    StepTimes times(sim);
    const long long builds_before = sim.fluid->neighbours.builds;
    const double begun = steady_seconds();
    int rounds = 0;
    while (rounds < asked ||
           (rounds < most_rounds * asked && steady_seconds() - begun < shortest_timing)) {
        ++rounds;
        for (Variant& variant : all) {
            sim.fluid->effects = variant.effects;
            const double lists = spent(sim).lists;
            const double start = steady_seconds();
            step(sim);
            const double seconds = steady_seconds() - start;
            times.add(sim);
            variant.seconds.push_back(seconds - (spent(sim).lists - lists));
        }
    }
    // Lists are constructed in some steps only: their frequency is the mean over all steps.
    const double timed = rounds * static_cast<double>(all.size());
    const Spent of_all = times.mean();
    cost.bodies = of_all.bodies;
    const auto builds = static_cast<double>(sim.fluid->neighbours.builds - builds_before) / timed;
    cost.build = seconds_of_build(*sim.fluid);
    cost.lists = std::min(builds * cost.build, of_all.lists);
    cost.seconds = mean_without_stalls(all.front().seconds) + cost.lists;
    cost.slowdown = times.slowdown();
    for (const Variant& variant : all) {
        if (!variant.without.empty()) {
            cost.effects.push_back(share_of(variant.without, shares(all.front(), variant, of_all)));
        }
    }
    return cost;
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
    if (half == 0 || (!done && total(all.last(half)) > grows * total(all.first(half)))) {
        return {};
    }
    const auto count = static_cast<double>(all.size());
    cost.seconds = cost.bodies = total(all) / count;
    cost.impacts *= done ? 1 : std::max(1.0, sim.plan.expected_steps / count);
    return cost;
}

std::optional<Development> measure_development(Simulation& sim, Simulation& again, int first,
                                               const std::function<bool()>& goes_on)
{
    const double start = steady_seconds();
    const auto particles = static_cast<double>(sim.fluid->particles.fluid.size());
    cut_no_step(sim);
    Passed passed;
    try {
        count_step(sim, passed);
        StepTimes times(sim);
        EarlySteps early_steps(again, first, sim.plan.expected_steps);
        while (!finished(sim.clock, sim.scene)) {
            if (!goes_on()) {
                return {};
            }
            count_step(sim, passed);
            times.add(sim);
            early_steps.follow(static_cast<double>(sim.clock.step));
        }
        const auto steps = static_cast<double>(sim.clock.step);
        if (steps <= first) {
            return {};
        }
        const double late = times.mean().all_else;
        const double early = early_steps.mean();
        if (!(early > 0)) {
            return {};
        }
        const auto left = static_cast<double>(sim.fluid->particles.fluid.size());
        return Development{.steps = steps / sim.plan.expected_steps,
                           .step = late / early,
                           .builds = static_cast<double>(sim.fluid->neighbours.builds) / steps,
                           .seconds = steady_seconds() - start,
                           .slowdown = times.slowdown(),
                           .fluid = passed.fluid_time / (particles * sim.clock.time),
                           .fluid_end = left / particles,
                           .impacts = passed.impacts};
    } catch (const NumericalError&) {
        return {};
    }
}

} // namespace hyoryu
