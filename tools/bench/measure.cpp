// SPDX-License-Identifier: MIT
#include "measure.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <numeric>

namespace hyoryu::bench {

namespace {

// Blocks of a run, at most: long enough that reading the clock costs nothing. In a heap every step
// is a block.
constexpr int blocks = 40;
// Samples of an accuracy run: fine enough that an apex or a dip between two of them is seen.
constexpr long long most_samples = 25000;
// Rounds of the timing: at least the fewest, and more while they are short.
constexpr int fewest_rounds = 3;
constexpr int most_rounds = 20;
constexpr double enough_time = 1; // [s]
// After so much of it no further round is begun: large heaps take minutes.
constexpr double patience = 300; // [s]

struct Variant {
    const Engine* engine;
    Result result;
    std::vector<double> block_costs; // least CPU time of each block of steps [s]
    long long block_steps = 0;
};

double cpu_time()
{
    std::timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

long long steps_of(const Scene& scene, double dt)
{
    return std::llround(scene.duration / dt);
}

Sample sample(const World& world, const Scene& scene, double time)
{
    Sample s{time, {}};
    for (int k = 0; k < static_cast<int>(scene.solids.size()); ++k) {
        s.states.push_back(world.state(k));
    }
    return s;
}

void judge(const Scene& scene, const Trace& trace, Result& result)
{
    for (const Metric& metric : scene.metrics) {
        result.metrics.push_back(metric.measure(scene, trace));
    }
}

Trace run(World& world, const Scene& scene, double dt)
{
    const long long steps = steps_of(scene, dt);
    const long long stride = (steps + most_samples - 1) / most_samples;
    Trace trace{sample(world, scene, 0)};
    for (long long n = 1; n <= steps; ++n) {
        world.step();
        if (n % stride == 0 || n == steps) {
            trace.push_back(sample(world, scene, static_cast<double>(n) * dt));
        }
    }
    return trace;
}

// One timed run; the first also counts contacts, and judges a heap by its end.
void time_once(const Scene& scene, const Plan& plan, Variant& variant)
{
    Result& result = variant.result;
    const long long steps = steps_of(scene, result.dt);
    variant.block_steps = scene.kind == Scene::Kind::heap ? 1 : (steps + blocks - 1) / blocks;
    const auto world = variant.engine->make(scene, result.dt);
    const Sample start = sample(*world, scene, 0);
    double spent = 0;
    long long done = 0;
    for (std::size_t block = 0; done < steps && spent < plan.budget; ++block) {
        const long long end = std::min(steps, done + variant.block_steps);
        const double from = cpu_time();
        for (; done < end; ++done) {
            world->step();
        }
        const double cost = cpu_time() - from;
        spent += cost;
        if (block == variant.block_costs.size()) {
            variant.block_costs.push_back(cost);
        }
        variant.block_costs[block] = std::min(variant.block_costs[block], cost);
    }
    if (result.repeats++ == 0) {
        result.steps = done;
        result.stopped = done < steps;
        result.contacts = world->contacts();
        if (scene.kind == Scene::Kind::heap) {
            const double time = static_cast<double>(done) * result.dt;
            judge(scene, {start, sample(*world, scene, time)}, result);
        }
    }
}

double mean_cost(const Variant& variant, std::size_t first, std::size_t last)
{
    const auto begin = variant.block_costs.begin();
    const double sum = std::accumulate(begin + static_cast<std::ptrdiff_t>(first),
                                       begin + static_cast<std::ptrdiff_t>(last), 0.0);
    const auto steps = [&](std::size_t block) {
        return std::min(variant.result.steps, static_cast<long long>(block) * variant.block_steps);
    };
    return sum / static_cast<double>(steps(last) - steps(first));
}

// A heap's path depends on every rounding: a second step size would tell nothing.
std::vector<Variant> variants_of(const Scene& scene, const std::vector<Engine>& engines)
{
    const bool exact = scene.kind == Scene::Kind::exact;
    std::vector<Variant> variants;
    for (const Engine& engine : engines) {
        for (const double dt : engine.steps) {
            const bool fits = scene.solids.size() <= engine.most_bodies;
            if (fits && (exact || dt == engine.steps.front())) {
                variants.push_back({&engine, {engine.name, dt}, {}});
            }
        }
    }
    return variants;
}

void time_all(const Scene& scene, const Plan& plan, std::vector<Variant>& variants)
{
    const double from = cpu_time();
    const auto go_on = [&](int rounds) {
        const double spent = cpu_time() - from;
        const double limit = rounds < fewest_rounds ? patience : enough_time;
        return rounds == 0 || (rounds < most_rounds && spent < limit);
    };
    for (int rounds = 0; go_on(rounds); ++rounds) {
        for (Variant& variant : variants) {
            // A run that met the budget, or one at a finer step that costs are not given at, is
            // not worth another.
            const bool costs_count = variant.result.dt == variant.engine->steps.front();
            if (rounds == 0 || (costs_count && !variant.result.stopped)) {
                time_once(scene, plan, variant);
            }
        }
    }
}

} // namespace

std::vector<Result> measure(const Scene& scene, const std::vector<Engine>& engines,
                            const Plan& plan)
{
    std::vector<Variant> variants = variants_of(scene, engines);
    time_all(scene, plan, variants);
    std::vector<Result> results;
    for (Variant& variant : variants) {
        Result& result = variant.result;
        const std::size_t count = variant.block_costs.size();
        const std::size_t quarter = std::max<std::size_t>(1, count / 4);
        result.cost = mean_cost(variant, 0, count);
        result.early_cost = mean_cost(variant, 0, quarter);
        result.late_cost = mean_cost(variant, count - quarter, count);
        if (scene.kind == Scene::Kind::exact) {
            if (result.stopped) {
                result.metrics.assign(scene.metrics.size(),
                                      std::numeric_limits<double>::quiet_NaN());
            } else {
                judge(scene, run(*variant.engine->make(scene, result.dt), scene, result.dt),
                      result);
            }
        }
        results.push_back(result);
    }
    return results;
}

} // namespace hyoryu::bench
