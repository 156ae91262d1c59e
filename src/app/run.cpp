// SPDX-License-Identifier: MIT
// The outer loop of a run: step, write due output, show progress, stop on request.
#include "build_info.hpp"
#include "commands.hpp"
#include "cost_report.hpp"
#include "forecast.hpp"
#include "machine_load.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "plan_report.hpp"
#include "progress.hpp"
#include "resume.hpp"
#include "stop_request.hpp"
#include "summary.hpp"
#include "tables.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/parallel.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/disk.hpp"
#include "hyoryu/scene/machine_memory.hpp"
#include "hyoryu/sim/checkpoint.hpp"
#include "hyoryu/sim/gauges.hpp"
#include "hyoryu/sim/watch.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <iterator>

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

// The folder itself, or the one in which it will be made.
fs::path existing_part_of(const fs::path& folder)
{
    std::error_code fault;
    fs::path place = fs::absolute(folder, fault);
    while (place.has_relative_path() && !fs::exists(place, fault)) {
        place = place.parent_path();
    }
    return place;
}

// Checked before anything is written or replaced. The space of results that will be replaced counts
// as free.
void check_disk(const fs::path& folder, const Scene& scene, const Plan& plan)
{
    const double needed = disk_bytes(scene, plan, {.steps = plan.expected_steps});
    std::error_code error;
    const auto space = fs::space(existing_part_of(folder), error);
    const double room = static_cast<double>(space.available) + bytes_in(folder);
    if (!error && needed > room) {
        throw IoError(fmt::format("the results need about {}, but only {} are free at {}",
                                  readable_bytes(needed), readable_bytes(room), folder.string()));
    }
}

// The case itself may lie in the folder and be named as a run names its copy.
void keep_the_case(const RunOptions& options, const fs::path& folder, const std::string& case_text)
{
    std::error_code fault;
    const fs::path copy = folder / "case.toml";
    if (!fs::equivalent(copy, options.case_file, fault)) {
        return;
    }
    std::ifstream stream(copy, std::ios::binary);
    const std::string typed{std::istreambuf_iterator<char>(stream), {}};
    if (typed != case_text) {
        throw CaseError(fmt::format("`{}` would replace the case itself, `{}`", folder.string(),
                                    options.case_file.string()),
                        "choose another folder with -o");
    }
}

void check_memory(const Plan& plan)
{
    const double memory = machine_memory();
    if (plan.memory > memory) {
        throw CaseError(
            fmt::format(
                "the run needs about {} of memory, but only {} are available to this process",
                readable_bytes(plan.memory), readable_bytes(memory)),
            "increase `particles.spacing`");
    }
}

struct Job {
    FolderLock lock;
    fs::path folder;
    std::string case_text;
    Simulation sim;
    Progress progress;
    std::optional<Outputs> outputs;
    std::int64_t first_step = 0;
    std::int64_t good_step = 0;  // of `last_good`
    std::int64_t saved_step = 0; // of the last checkpoint
    /// At the last frame; none while the checkpoint on disk is newer and no recovery needs it.
    std::optional<Snapshot> last_good = {};
    double until = infinity;
    std::string command_to_go_on; // for the user, where the run stops before its end
    CoreWatch cores = {};
    std::map<std::string, std::string> given = {}; // texts of checkpoints beside the case
};

void write_closing(Job& job, const std::string& reason)
{
    write_text(job.folder / "summary.json",
               summary_json(job.sim, reason, job.progress.wall_seconds(), job.first_step,
                            job.outputs->timer(), job.outputs->frame_cost()));
    write_master(job.folder, job.case_text, std::string(build_info::version));
}

Snapshot state_of(const Job& job)
{
    Snapshot state = job.outputs->snapshot(job.sim);
    state.texts["case"] = job.case_text;
    state.texts.insert(job.given.begin(), job.given.end());
    return state;
}

// The old state goes before the new one comes: a state is as large as that of the particles.
void keep_good_state(Job& job)
{
    job.outputs->timer().begin("good state");
    job.last_good.reset();
    job.last_good = state_of(job);
    job.good_step = job.sim.clock.step;
    job.outputs->timer().end();
}

// Writes the present state to the disk. It takes the place of an older one in memory, unless the
// run may return to that: a recovery must not depend on when checkpoints were written.
void write_checkpoint(Job& job)
{
    job.outputs->timer().begin("checkpoints");
    if (!job.sim.scene.time.recover) {
        job.last_good.reset();
    }
    job.outputs->settle(); // frames on their way are nearly as large as the state
    job.outputs->write_checkpoint(state_of(job));
    job.saved_step = job.sim.clock.step;
    job.outputs->timer().end();
}

// Returns to the last frame and continues from there with half the step. Output written since is
// removed.
void recover(Job& job, const NumericalError& error)
{
    const Scene& scene = job.sim.scene;
    Simulation sim = make_simulation(scene, job.sim.plan, fill(scene));
    restore(sim, *job.last_good);
    sim.clock.share = 0.5 * job.sim.clock.share;
    job.sim.timer.end(); // of the failed stage
    sim.timer = job.sim.timer;
    sim.steps_by_limit = job.sim.steps_by_limit;
    sim.pair_visits = job.sim.pair_visits;
    job.progress.line(fmt::format("note: the simulation became unstable: {}", error.what()));
    job.progress.line(fmt::format(
        "recovery: back to t = {} s, then to the end with time steps of {} of the limits",
        sim.clock.time, sim.clock.share));
    job.outputs.reset(); // all that it holds back is on disk before it is read again
    job.outputs.emplace(job.folder, sim, *job.last_good);
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

void advance(Job& job)
{
    Simulation& sim = job.sim;
    double saved = job.progress.wall_seconds();
    while (!finished(sim.clock, sim.scene) && sim.clock.time < job.until && !stop_requested()) {
        if (!step_or_recover(job)) {
            continue;
        }
        const std::int64_t frame = sim.clock.frame;
        job.outputs->update(sim);
        if (sim.clock.frame != frame) {
            keep_good_state(job);
        }
        if (job.progress.wall_seconds() - saved > sim.scene.output.checkpoint_every) {
            write_checkpoint(job);
            saved = job.progress.wall_seconds();
        }
        job.progress.update(sim);
    }
}

// Warnings that a user should know before trusting the numbers.
void tell_doubts(Job& job)
{
    constexpr double noteworthy = 0.1; // ten times the variation that the sound speed aims at
    const double compression = job.sim.conservation.worst_density_error;
    if (compression > noteworthy) {
        job.progress.line(fmt::format("note: the density error reached {:.0f} %, which is typical "
                                      "of fluid squeezed between solids",
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
            job.sim.conservation.worst_in_solids, particles_in_solids(job.sim)));
    }
    if (const std::vector<int> outside = bodies_outside(job.sim); !outside.empty()) {
        const Body& first = job.sim.rigid.bodies[static_cast<std::size_t>(outside.front())];
        job.progress.line(fmt::format(
            "note: {} wholly below or beside the domain of the fluid at the end, "
            "first \"{}\" at ({:.4g}, {:.4g}, {:.4g}) m",
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
    const bool stopped = !done && stop_requested();
    const std::string reason = done ? "done" : (stopped ? "interrupted" : "until");
    if (done) {
        job.outputs->close_interval(job.sim);
    }
    count_in_solids(job.sim);
    write_checkpoint(job);
    write_closing(job, reason);
    job.progress.end(job.sim);
    tell_doubts(job);
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
    tell_cost(job);
    return exit_code::done;
}

// The state of the last frame was good; a run can go on from it with other settings.
void give_up(Job& job, const std::string& error, const std::string& exit_reason)
{
    job.progress.abandon("error: " + error);
    if (job.last_good && job.good_step > job.saved_step) {
        job.outputs->write_checkpoint(std::move(*job.last_good));
    }
    write_closing(job, exit_reason);
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

// Steps that may be timed before this run.
TimingBudget timing_budget(const RunOptions& options, const Scene& scene, const Plan& plan)
{
    const double end = std::min(options.until.value_or(infinity), scene.time.end);
    return {.steps = steps_to_time(plan, plan.expected_steps),
            .part = 0.02,
            .least = 1,
            .most = 20,
            .part_run = end / scene.time.end};
}

Job start(const RunOptions& options, const fs::path& folder, const Scene& scene, const Plan& plan,
          Filling filling)
{
    const std::string case_text = to_toml(scene);
    keep_the_case(options, folder, case_text);
    check_disk(folder, scene, plan);
    FolderLock lock = prepare_results(folder, options.force ? Existing::replace : Existing::refuse);
    TimingBudget budget = timing_budget(options, scene, plan);
    budget.file = seconds_to_write(folder / "case.toml", case_text);
    const std::optional<StepCost> timed =
        time_case({options.case_file, options.overrides}, scene, plan, filling, budget);
    write_text(folder / "plan.json", plan_json(scene, plan, timed));
    Simulation sim = make_simulation(scene, plan, filling);
    const Bounds domain = filling.domain;
    filling = {}; // as large as the state of the fluid, and no more needed
    Progress progress(folder, options.quiet ? Verbosity::quiet : Verbosity::normal, 0);
    Outputs outputs(folder, sim, domain);
    Job job{std::move(lock),   folder, case_text, std::move(sim), std::move(progress),
            std::move(outputs)};
    job.given = texts_of_given_case(options, scene);
    job.outputs->update(job.sim);
    if (scene.time.recover) {
        keep_good_state(job);
    }
    write_checkpoint(job);
    return job;
}

// Restores the plan of the folder if the case has changed or the file is missing.
void write_case(const fs::path& folder, const Scene& scene, const Plan& plan)
{
    write_text(folder / "case.toml", to_toml(scene));
    write_text(folder / "plan.json", plan_json(scene, plan, {}));
}

Job resume(const RunOptions& options, const fs::path& folder, Resumption from, const Plan& plan,
           Filling filling)
{
    const Scene& scene = from.scene;
    FolderLock lock = prepare_results(folder, Existing::extend);
    Simulation sim = make_simulation(scene, plan, filling);
    filling = {}; // as large as the state of the fluid, and no more needed
    restore(sim, from.state);
    const std::int64_t first_step = sim.clock.step;
    Progress progress(folder, options.quiet ? Verbosity::quiet : Verbosity::normal, sim.clock.time);
    progress.line(fmt::format("resuming from t = {} s, step {}", sim.clock.time, sim.clock.step));
    if (!from.passed_over.empty()) {
        take_previous_checkpoint(folder);
        progress.line(fmt::format("note: {}; using the previous checkpoint", from.passed_over));
    }
    change_columns(folder, energy_table(scene)); // of a version that wrote fewer
    if (scene.gauges.empty()) {
        set_aside(folder, "gauges");
    } else {
        change_columns(folder, gauges_table(gauge_heads(scene)));
    }
    if (!scene.open.empty()) {
        change_columns(folder, open_table(scene));
    }
    Outputs outputs(folder, sim, from.state);
    if (from.changed || !fs::exists(folder / "plan.json")) {
        write_case(folder, scene, plan);
    }
    const bool changed = from.changed;
    Job job{std::move(lock),
            folder,
            to_toml(scene),
            std::move(sim),
            std::move(progress),
            std::move(outputs),
            first_step,
            first_step,
            first_step,
            scene.time.recover ? std::optional(std::move(from.state)) : std::nullopt};
    job.given = texts_of_given_case(options, scene);
    if (changed) { // or a kill would leave a checkpoint of the case before
        write_checkpoint(job);
    }
    return job;
}

} // namespace

int run_case(const RunOptions& options)
{
    watch_for_batch_signal();
    set_threads(options.threads);
    const fs::path folder = results_folder(options);
    Scene scene = read_case(options.case_file, options.overrides);
    std::optional<Resumption> from;
    if (options.resume) {
        from = resumption_of(options, folder, scene);
        scene = from->scene;
    }
    Filling filling = fill(scene);
    const Plan plan = make_plan(scene, filling);
    watch_for_stop();
    if (!options.quiet) {
        for (const Diagnostic& warning : plan.warnings) {
            std::fputs((to_string(warning) + "\n").c_str(), stderr);
        }
    }
    check_memory(plan);
    Job job = from ? resume(options, folder, std::move(*from), plan, std::move(filling))
                   : start(options, folder, scene, plan, std::move(filling));
    from.reset();
    job.until = options.until.value_or(infinity);
    job.command_to_go_on = command_to_go_on(options, folder);
    return carry_out(job);
}

} // namespace hyoryu
