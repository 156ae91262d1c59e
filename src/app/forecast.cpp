// SPDX-License-Identifier: MIT
#include "forecast.hpp"

#include "machine_load.hpp"
#include "stop_request.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/parallel.hpp"
#include "hyoryu/io/results.hpp"
#include "hyoryu/scene/moving_walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hyoryu {

namespace {

// Seconds of a thread for a step of one fluid particle in two and in three dimensions, of one wall
// particle, of which most are dry, and of a step besides: fitted to the measured runs of 2-D and
// 3-D cases in docs/forecast.md and docs/how-it-is-fast.md (two threads, AVX-512), which they meet
// within a third, the dam break of 8.5 mm within a tenth. A forecast from it is an order of
// magnitude on another machine, not a promise.
constexpr double fluid_seconds_2d = 0.26e-6;
constexpr double fluid_seconds_3d = 0.42e-6;
constexpr double wall_seconds = 0.2e-6;
constexpr double step_seconds = 80e-6;

// How much longer a step of fluid takes with AVX2 than with AVX-512: 2.16 against 1.38 M
// particle-steps a second of the same dam break, on two machines (docs/how-it-is-fast.md).
constexpr double without_avx512 = 1.6;

// A box that falls into a heap and rests there, measured with one thread over whole runs of 1,000
// and 1,960 boxes. At rest it takes half of that, in flight a tenth.
constexpr double body_seconds = 35e-6;

// Impacts of a body in a heap in a step, over a whole run of 1,960 boxes; runs of 490 had 0.43 to
// 0.58. Fewer bodies are not a heap.
constexpr double heap_impacts = 0.72;
constexpr Index heap_bodies = 100;

// Particles that gauges look at in a second: kernel sums of 100 gauges of each kind in the debris
// flood, with one thread. Gauges run side by side, but a single one does not.
constexpr double gauge_rate = 0.1e9;

// A trial run too short to be noticed [s]; most small scenes of bodies end within it.
constexpr double shortest_look = 0.1;

// The text of one row of a history, and a frame beside its way to the disk, as the writer's thread
// counts its own time in runs of small scenes [s].
constexpr double row_text = 5e-6;
constexpr double frame_work = 1e-3;

// Files that every run writes besides its frames, and the work to close them: checkpoints,
// histories, walls, structures, results.h5, the summary.
constexpr double files_of_a_run = 22;

// Particles of fluid in the middle between the start and the most that open sides may bring.
double mean_fluid(const Plan& plan)
{
    const auto start = static_cast<double>(plan.counts.fluid);
    return std::max(start, (start + static_cast<double>(plan.most_fluid)) / 2);
}

// Wall time of a step where nothing was timed, from fixed rates [s]: an order of magnitude. Each of
// several processes has the threads of this one; what they send is not counted.
double untimed_step(const Plan& plan, int processes)
{
    const double bodies = static_cast<double>(plan.counts.bodies) * body_seconds;
    if (!plan.fluid) {
        return bodies;
    }
    const double of_fluid = plan.fluid->dimensions == 2 ? fluid_seconds_2d : fluid_seconds_3d;
    const double particles =
        of_fluid * mean_fluid(plan) + wall_seconds * static_cast<double>(plan.counts.wall);
    const double set = widest_instruction_set() == InstructionSet::avx512 ? 1.0 : without_avx512;
    return step_seconds + set * particles / (thread_count() * processes) + bodies;
}

double frame_files(const Scene& scene, const Plan& plan)
{
    const bool moving = has_moving_walls(scene);
    return plan.frames * ((plan.fluid ? 1 : 0) + (scene.bodies.empty() ? 0 : 2) + (moving ? 2 : 0));
}

// Cost of output per step: rows, written by the solver; frames, where the writer thread is slower
// than the solver; and the files of a run.
double output_of_step(const Scene& scene, const Plan& plan, const StepCost& cost, double file)
{
    const double steps = expected_steps(plan, cost);
    const double every = scene.output.history_every;
    const double rows = every > 0 ? std::min(steps, scene.time.end / every) : steps;
    const double texts = row_text * (1 + static_cast<double>(plan.counts.bodies));
    const double work = frame_files(scene, plan) * frame_work;
    const double writer = frame_files(scene, plan) * file + work;
    const double waits = std::max(0.0, writer - steps * seconds_of_run(cost));
    // The solver's threads occupy all cores, so the work of the writer slows them.
    const double taken = plan.fluid ? work / thread_count() : 0;
    return (rows * (cost.row + texts) + waits + taken + files_of_a_run * file) / steps;
}

double limit_of(const TimingBudget& budget, double run)
{
    // Half of the particles along each edge are an eighth of the work in two dimensions, and some
    // more: small loops are less efficient.
    constexpr double share_of_coarsest = 0.15;
    const double least = std::min(budget.least, share_of_coarsest * run);
    return std::clamp(budget.part * run, std::max(shortest_look, least), budget.most);
}

std::optional<StepCost> time_bodies(const Scene& scene, const Plan& plan, const Filling& filling,
                                    const TimingBudget& budget)
{
    Simulation sim = make_simulation(scene, plan, filling);
    const double limit = limit_of(budget, wall_forecast(plan, {}));
    const double row = measure_row(sim);
    const double start = steady_seconds();
    std::optional<StepCost> cost =
        measure_bodies(sim, [&] { return steady_seconds() - start < limit && !stop_requested(); });
    if (cost) {
        cost->row = row;
    }
    return cost;
}

std::optional<StepCost> time_fluid(const CaseSource& source, const Scene& scene, const Plan& plan,
                                   const Filling& filling, const TimingBudget& budget)
{
    std::optional<StepCost> cost;
    {
        Simulation sim = make_simulation(scene, plan, filling);
        const double row = measure_row(sim);
        cost = time_steps(sim, budget.steps);
        if (cost) {
            cost->row = row;
        }
    }
    if (cost) {
        const double run = cost->seconds * plan.expected_steps * budget.part_run;
        predict_development(source, plan, budget.steps, limit_of(budget, run), *cost);
    }
    return cost;
}

} // namespace

double seconds_to_write(const std::filesystem::path& file, const std::string& text)
{
    std::array<double, 3> seconds{};
    for (double& once : seconds) {
        const double start = steady_seconds();
        write_text(file, text);
        once = steady_seconds() - start;
    }
    std::ranges::sort(seconds);
    return seconds[1];
}

std::optional<StepCost> time_case(const CaseSource& source, const Scene& scene, const Plan& plan,
                                  const Filling& filling, const TimingBudget& budget)
{
    const CoreWatch watch;
    std::optional<StepCost> cost;
    try {
        if (plan.fluid && budget.steps > 0) {
            cost = time_fluid(source, scene, plan, filling, budget);
        } else if (!plan.fluid && plan.counts.bodies > 0) {
            cost = time_bodies(scene, plan, filling, budget);
        }
    } catch (const NumericalError&) {
        return {}; // the run itself tells where it becomes unstable
    }
    if (cost) {
        cost->output = output_of_step(scene, plan, *cost, budget.file);
        cost->waiting = watch.waiting();
    }
    return cost;
}

double expected_steps(const Plan& plan, const std::optional<StepCost>& timed)
{
    return timed && timed->development ? std::ceil(plan.expected_steps * timed->development->steps)
                                       : plan.expected_steps;
}

Course expected_course(const Plan& plan, const std::optional<StepCost>& timed)
{
    Course course{.steps = expected_steps(plan, timed)};
    if (timed) {
        course.impacts = timed->impacts;
    } else if (!plan.fluid && plan.contact && plan.counts.bodies >= heap_bodies) {
        course.impacts = heap_impacts * static_cast<double>(plan.counts.bodies) * course.steps;
    }
    if (timed && timed->development) {
        course.fluid = timed->development->fluid;
        course.fluid_end = timed->development->fluid_end;
        course.impacts = timed->development->impacts;
    }
    return course;
}

double gauge_seconds(const Plan& plan)
{
    return plan.gauge_rows * plan.gauge_looks / gauge_rate;
}

double wall_forecast(const Plan& plan, const std::optional<StepCost>& timed, int processes)
{
    double step = timed ? seconds_of_run(*timed) : untimed_step(plan, processes);
    if (timed && plan.fluid && !timed->development) { // which would include entering fluid
        const auto wall = static_cast<double>(plan.counts.wall);
        step *= (mean_fluid(plan) + wall) / (static_cast<double>(plan.counts.fluid) + wall);
    }
    return expected_steps(plan, timed) * step + gauge_seconds(plan);
}

} // namespace hyoryu
