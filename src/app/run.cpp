// SPDX-License-Identifier: MIT
// The outer loop of a run: step, write due output, show progress, stop on request.
#include "build_info.hpp"
#include "case_files.hpp"
#include "cost_report.hpp"
#include "job.hpp"
#include "options.hpp"
#include "plan_report.hpp"
#include "ranks.hpp"
#include "stop_request.hpp"
#include "summary.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/parallel.hpp"
#include "hyoryu/core/state.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/machine_memory.hpp"
#include "hyoryu/scene/memory.hpp"
#include "hyoryu/sim/checkpoint.hpp"
#include "hyoryu/sim/state_parts.hpp"
#include "hyoryu/sim/watch.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <numeric>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

// Least share of the limits on the time step: a run that is unstable even there is not cured by
// shorter steps.
constexpr double least_share = 1.0 / 32;

fs::path results_folder(const RunOptions& options)
{
    return options.folder.empty() ? fs::path(options.case_file.stem().string() + "-results")
                                  : options.folder;
}

constexpr double rows_enough = 10'000; // of a history

// Throws CaseError if the memory does not suffice; the hint names the cause: particles, or the
// histories of very many steps. `part`: of the particles that are on this machine.
void check_memory(const Scene& scene, const Plan& plan, double part)
{
    const double memory = machine_memory();
    const double needed = part * plan.memory;
    if (needed > memory) {
        const bool by_steps = part * memory_bytes(scene, plan, {}) < memory / 2;
        throw CaseError(
            fmt::format(
                "the run needs about {} of memory, but only {} are available to this process",
                readable_bytes(needed), readable_bytes(memory)),
            by_steps ? fmt::format("the histories have a row for each of {:.2g} steps: set "
                                   "`output.history_every`, for instance to {:.2g} s",
                                   plan.expected_steps, scene.time.end / rows_enough)
                     : "increase `particles.spacing`");
    }
}

// Called by all processes.
Closing closing_of(const Job& job)
{
    Closing now{.totals = totals(job.sim), .pair_visits = job.sim.pair_visits, .ranks = {}};
    if (job.sim.fluid) {
        now.fluid = count_over_ranks(*job.sim.fluid, job.sim.fluid->particles.fluid.size());
        now.in_solids = particles_in_solids(job.sim);
    }
    if (job.comm != nullptr) {
        const std::vector<double> visits =
            gather(*job.comm, std::span<const double>(&job.sim.pair_visits, 1)).all;
        now.pair_visits = std::reduce(visits.begin(), visits.end());
    }
    if (job.ranks != nullptr) {
        now.ranks = job.ranks->summary();
    }
    return now;
}

// Writes the summary and results.h5 at the end, whatever its reason. `now`: the state of all
// processes.
void write_closing(Job& job, const std::string& reason, const Closing& now)
{
    write_text(job.folder / "summary.json",
               summary_json(job.sim, now, reason, job.progress.wall_seconds(), job.first_step,
                            job.outputs->timer(), job.frames->cost()));
    write_master(job.folder, job.case_text, std::string(build_info::version));
}

// The last good state, of which each process has its share.
StateParts good_parts(const Job& job)
{
    StateParts state{.common = job.last_good->snapshot()};
    if (job.sim.fluid) {
        const int ranks = job.comm->size();
        state.count = ranks;
        state.particles = given_twice(gather_particles(
            job.sim, *job.comm, group_ranks(ranks, ranks), take_particles(job.sim, state.common)));
    }
    return state;
}

// Returns to the last frame and continues from there with half the step. Output written since is
// removed.
void recover(Job& job, const NumericalError& error)
{
    const Scene& scene = job.sim.scene;
    Filling filling = fill(scene, fillers_of(job.comm));
    Simulation sim = make_to_restore(scene, job.sim.plan, std::move(filling), job.comm);
    if (job.comm == nullptr) {
        restore(sim, job.last_good->snapshot());
    } else {
        restore(sim, job.comm, good_parts(job));
    }
    sim.clock.share = 0.5 * job.sim.clock.share;
    job.sim.timer.end(); // of the failed stage
    sim.timer = job.sim.timer;
    sim.steps_by_limit = job.sim.steps_by_limit;
    sim.pair_visits = job.sim.pair_visits;
    sim.earlier_visits = job.sim.earlier_visits;
    job.progress.line(fmt::format("note: the simulation became unstable: {}", error.what()));
    job.progress.line(fmt::format(
        "recovery: the run continues from t = {} s to the end with time steps of {} of the limits",
        sim.clock.time, sim.clock.share));
    if (job.outputs) {
        job.outputs.reset(); // all that it holds back is on disk before it is read again
        const Snapshot last = job.last_good->snapshot();
        job.outputs.emplace(job.folder, sim, &last);
    }
    job.frames->forget_after(sim.clock.time);
    job.sim = std::move(sim);
}

// One step; false if it failed and the run has returned to an earlier state with shorter steps.
bool step_or_recover(Job& job)
{
    try {
        step(job.sim);
        // Before a history row, or a good state.
        if (history_due(job.sim.clock, job.sim.scene) || frame_due(job.sim.clock, job.sim.scene)) {
            watch_energy(job.sim, totals(job.sim));
        }
        return true;
    } catch (const RoomError&) {
        throw; // shorter steps make no room
    } catch (const NumericalError& error) {
        if (!job.sim.scene.time.recover || job.sim.clock.share <= least_share) {
            throw;
        }
        recover(job, error);
        return false;
    }
}

// The action after a step. Of the requests of all processes, the last one in this order counts.
enum class Request : std::uint8_t { none, checkpoint, stop };

// Processes that share fluid get the largest request of all from the survey of the step.
Request request_of_all(Job& job, Request now)
{
    if (job.comm != nullptr && job.sim.fluid) {
        return static_cast<Request>(job.sim.last->request);
    }
    const auto [stop, save] =
        any_wishes<2>(job.comm, {now == Request::stop, now == Request::checkpoint});
    return stop ? Request::stop : (save ? Request::checkpoint : Request::none);
}

void advance(Job& job)
{
    Simulation& sim = job.sim;
    double saved = job.progress.wall_seconds();
    std::optional<StopFile> file;
    if (writes(job.comm)) {
        file.emplace(job.folder);
    }
    const auto asked = [&] { return stop_requested() || (file && file->requested()); };
    const auto wished = [&] {
        const double since = job.progress.wall_seconds() - saved;
        const bool save = writes(job.comm) && since > sim.scene.output.checkpoint_every;
        return asked() ? Request::stop : (save ? Request::checkpoint : Request::none);
    };
    bool stop = any_wishes<1>(job.comm, {asked()})[0];
    while (!finished(sim.clock, sim.scene) && sim.clock.time < job.until && !stop) {
        sim.request = static_cast<double>(wished());
        if (job.ranks != nullptr) {
            job.ranks->begin_step();
        }
        if (!step_or_recover(job)) {
            continue;
        }
        if (job.ranks != nullptr) {
            job.ranks->balance_work(sim);
        }
        update_outputs(job);
        const Request request = request_of_all(job, wished());
        stop = request == Request::stop;
        if (request == Request::checkpoint) {
            write_checkpoint(job);
            saved = job.progress.wall_seconds();
        }
        if (writes(job.comm)) {
            job.progress.update(sim);
        }
    }
    job.stopped = stop;
}

// Warnings that a user should know before trusting the numbers.
void tell_doubts(Job& job, const Closing& now)
{
    constexpr double noteworthy = 0.1; // ten times the variation that the sound speed aims at
    const double compression = job.sim.conservation.worst_density_error;
    if (compression > noteworthy) {
        job.progress.line(fmt::format("note: the density error reached {:.0f} %, about 1 % is "
                                      "expected: pressures and forces were inaccurate then",
                                      100 * compression));
    }
    if (job.sim.fluid && job.sim.fluid->lost.count > 0) {
        job.progress.line(fmt::format("note: {} fluid particles left the domain and were removed",
                                      job.sim.fluid->lost.count));
    }
    if (job.sim.conservation.worst_in_solids > 0) {
        job.progress.line(fmt::format(
            "note: up to {} fluid particles were more than a quarter of a spacing inside a wall or "
            "body at one time, {} at the end",
            job.sim.conservation.worst_in_solids, now.in_solids));
    }
    if (const std::vector<int> outside = bodies_outside(job.sim); !outside.empty()) {
        const Body& first = job.sim.rigid.bodies[static_cast<std::size_t>(outside.front())];
        job.progress.line(fmt::format(
            "note: {} completely below or beside the domain of the fluid at the end, first \"{}\" "
            "at ({:.4g}, {:.4g}, {:.4g}) m",
            outside.size() == 1 ? "one body is" : fmt::format("{} bodies are", outside.size()),
            first.name, first.position.x(), first.position.y(), first.position.z()));
    }
    if (job.sim.rigid.counters.capped_steps > 0) {
        job.progress.line(fmt::format(
            "note: impacts were resolved by time stepping, not located, in {} of {} steps",
            job.sim.rigid.counters.capped_steps, job.sim.clock.step));
    }
}

// The state of the end is on disk: the steps that are timed now belong to nothing.
void tell_cost(Job& job)
{
    const auto steps = static_cast<double>(job.sim.clock.step - job.first_step);
    const int timed = steps_to_time(job.sim.plan, steps);
    const SpentCost spent{job.progress.wall_seconds(), steps,
                          peak_memory(), // before the steps that are timed now
                          job.cores.waiting()};
    write_cost(job.folder, spent, time_steps(job.sim, timed));
}

int finish(Job& job)
{
    const bool done = finished(job.sim.clock, job.sim.scene);
    const bool stopped = !done && job.stopped;
    const std::string reason = done ? "done" : (stopped ? "interrupted" : "until");
    if (done && job.outputs) {
        job.outputs->write_resting(job.sim);
    }
    count_in_solids(job.sim);
    write_checkpoint(job);
    const Closing now = closing_of(job);
    if (!writes(job.comm)) {
        return stopped ? exit_code::interrupted : exit_code::done;
    }
    write_closing(job, reason, now);
    job.progress.end(job.sim);
    tell_doubts(job, now);
    if (stopped) {
        job.progress.line("interrupted; checkpoint written. Resume with: " + job.command_to_go_on);
        return exit_code::interrupted;
    }
    job.progress.line(
        fmt::format("{} after {}; results in {}", done ? "done" : "stopped as requested",
                    readable_seconds(job.progress.wall_seconds()), job.folder.string()));
    if (!done) {
        job.progress.line("resume with: " + job.command_to_go_on);
    }
    if (job.comm == nullptr) {
        tell_cost(job);
    }
    return exit_code::done;
}

// The state of the last frame was good; a run can go on from it with other settings.
void give_up(Job& job, const std::string& error, const std::string& exit_reason)
{
    const Closing now = closing_of(job);
    job.progress.abandon("error: " + error);
    if (job.last_good && job.good_step > job.saved_step) {
        write_state(job, job.last_good->on_demand());
    }
    if (writes(job.comm)) {
        write_closing(job, exit_reason, now);
    }
}

int carry_out(Job& job)
{
    try {
        advance(job);
        return finish(job);
    } catch (const RoomError& error) {
        give_up(job, error.what(), "too many particles");
        throw;
    } catch (const NumericalError& error) {
        give_up(job, fmt::format("the simulation became unstable: {}", error.what()),
                "numerical error");
        throw;
    }
}

std::vector<Common> what_processes_share(const RunOptions& options, const Scene& scene)
{
    std::string files;
    for (const auto& [name, text] : texts_of_given_case(options, scene)) {
        files.append(name).append(1, '=').append(text).append(1, '\n');
    }
    return {{"program", fmt::format("{} {}", build_info::version, build_info::commit)},
            {"case", to_toml(scene)},
            {"files of the case", files},
            {"options", fmt::format("{} {} {} {} {}", results_folder(options).string(),
                                    options.until.value_or(infinity), options.rebalance,
                                    options.parts, options.resume)}};
}

void tell_warnings(const RunOptions& options, const Plan& plan)
{
    if (!options.quiet) {
        for (const Diagnostic& warning : plan.warnings) {
            std::fputs((to_string(warning) + "\n").c_str(), stderr);
        }
    }
}

// The run, or what this process does of it.
int run_share(const RunOptions& options, Ranks& others)
{
    CountedComm* const comm = others.comm();
    set_threads(options.threads);
    const fs::path folder = results_folder(options);
    Scene scene;
    std::vector<Common> common;
    others.together([&] {
        scene = comm == nullptr ? read_whole_case(options.case_file, options.overrides)
                                : read_case(options.case_file, options.overrides);
        common = what_processes_share(options, scene);
    });
    expect_common(comm, common);
    std::optional<Resumption> from;
    if (options.resume) {
        from = resumption_for_all(options, folder, scene, comm);
        scene = from->scene;
    }
    const Fillers fillers = fillers_of(comm);
    Filling filling = fill(scene, fillers);
    const Plan plan = make_plan(scene, filling, comm);
    watch_for_stop();
    if (writes(comm)) {
        tell_warnings(options, plan);
        check_memory(scene, plan, fillers.part);
    }
    std::optional<RankLog> ranks;
    if (comm != nullptr) {
        ranks.emplace(*comm, options.rebalance);
    }
    const Beginning beginning{options, folder, scene, plan, comm, ranks ? &*ranks : nullptr};
    Job job = from ? resume(beginning, std::move(*from), std::move(filling))
                   : start(beginning, std::move(filling));
    from.reset();
    job.until = options.until.value_or(infinity);
    const std::string launcher =
        job.comm == nullptr ? "" : fmt::format("mpirun -n {} ", job.comm->size());
    job.command_to_go_on = launcher + command_to_go_on(options, folder);
    return carry_out(job);
}

} // namespace

int run_case(const RunOptions& options)
{
    watch_for_batch_signal();
    Ranks ranks;
    if (ranks.comm() == nullptr) {
        return run_share(options, ranks);
    }
    try {
        return run_share(options, ranks);
    } catch (...) {
        ranks.end(std::current_exception());
    }
}

} // namespace hyoryu
