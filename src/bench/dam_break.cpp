// SPDX-License-Identifier: MIT
#include "dam_break.hpp"

#include "clock.hpp"
#include "pairs.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/parallel.hpp"
#include "hyoryu/io/results.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/sim/checkpoint.hpp"

#include <fmt/format.h>

namespace hyoryu::bench {

namespace {

// Nothing is ever written: the first frame comes after the end of every measurement.
constexpr const char* case_text = R"(
title = "Dam break with a column"
[time]
end = 100.0
[particles]
spacing = {}
[fluid]
sound_speed = 34.3
[fluid.viscosity]
model = "artificial"
alpha = 0.05
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.4, 0.67, 0.3]
[[wall]]
name = "tank"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [1.6, 0.67, 0.4]
open = ["+z"]
[[wall]]
name = "column"
shape = "box"
min = [0.9, 0.24, 0.0]
max = [1.02, 0.36, 0.45]
[output]
every = 100.0
)";

void advance(Simulation& sim)
{
    step(sim);
    sim.clock.frame += frame_due(sim.clock, sim.scene) ? 1 : 0;
}

bool restored(Simulation& sim, double time, const std::filesystem::path& folder)
{
    if (folder.empty() || !std::filesystem::exists(folder / "checkpoint.h5")) {
        return false;
    }
    const Snapshot state = read_checkpoint(folder);
    const auto of = state.texts.find("case");
    if (of == state.texts.end() || of->second != to_toml(sim.scene)) {
        return false;
    }
    restore(sim, state);
    return sim.clock.time >= time;
}

// One trial of a number of steps and threads; returns seconds per step.
double time_steps(Simulation& sim, int threads, int steps)
{
    set_threads(threads);
    return best_time(1,
                     [&] {
                         for (int k = 0; k < steps; ++k) {
                             advance(sim);
                         }
                     }) /
           steps;
}

using Stages = std::vector<StageTimer::Stage>;

// Keeps the times of all stages of the trial that was the fastest as a whole.
void book_stages(const Stages& before, const Stages& after, int steps, double StageTime::*which,
                 std::vector<StageTime>& stages)
{
    for (std::size_t k = 0; k < after.size(); ++k) {
        if (k >= stages.size()) {
            stages.push_back({after[k].name});
        }
        const double earlier = k < before.size() ? before[k].seconds : 0;
        stages[k].*which = (after[k].seconds - earlier) / steps;
    }
}

} // namespace

Simulation make_dam_break(double spacing)
{
    const Scene scene = parse_case(fmt::format(case_text, spacing), "dam_break");
    const Filling filling = fill(scene);
    return make_simulation(scene, make_plan(scene, filling), filling);
}

void develop(Simulation& sim, double time, const std::filesystem::path& folder)
{
    if (restored(sim, time, folder)) {
        return;
    }
    while (sim.clock.time < time) {
        advance(sim);
    }
    if (!folder.empty()) {
        std::filesystem::create_directories(folder);
        Snapshot state = save(sim);
        state.texts["case"] = to_toml(sim.scene);
        write_checkpoint(folder, state);
    }
}

StepRates measure_steps(Simulation& sim, const std::string& name, const Extent& extent, int threads)
{
    const FluidNeighbours& n = sim.fluid->neighbours;
    StepRates rates{.scene = name,
                    .time = sim.clock.time,
                    .spacing = sim.scene.spacing,
                    .fluid = sim.fluid->particles.fluid.size(),
                    .solid = sim.plan.counts.wall + sim.plan.counts.body,
                    .steps = extent.steps,
                    .threads = threads,
                    .one = infinity,
                    .all = infinity};
    time_steps(sim, threads, 5); // the first steps take memory and find their skins
    const long long builds = n.builds;
    const std::int64_t first = sim.clock.step;
    for (int k = 0; k < extent.tries; ++k) {
        for (const auto& [count, best, which] :
             {std::tuple(1, &rates.one, &StageTime::one),
              std::tuple(threads, &rates.all, &StageTime::all)}) {
            const Stages before = sim.timer.stages();
            const double seconds = time_steps(sim, count, extent.steps);
            if (seconds < *best) {
                *best = seconds;
                book_stages(before, sim.timer.stages(), extent.steps, which, rates.stages);
            }
        }
    }
    rates.pairs = 2 * (pairs_within_support(*sim.fluid, n.fluid_fluid) +
                       pairs_within_support(*sim.fluid, n.fluid_solid));
    rates.builds =
        static_cast<double>(n.builds - builds) / static_cast<double>(sim.clock.step - first);
    rates.memory = memory_of(*sim.fluid);
    return rates;
}

} // namespace hyoryu::bench
