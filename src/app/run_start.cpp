// SPDX-License-Identifier: MIT
// How a run begins: the folder and its files, the simulation, and the first output.
#include "build_info.hpp"
#include "cost_report.hpp"
#include "forecast.hpp"
#include "job.hpp"
#include "plan_report.hpp"
#include "ranks.hpp"
#include "stop_request.hpp"
#include "tables.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/disk.hpp"
#include "hyoryu/sim/checkpoint.hpp"
#include "hyoryu/sim/dealing.hpp"
#include "hyoryu/sim/gauges.hpp"
#include "hyoryu/sim/whole.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

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

// What processes begin with that do not write.
Job follower(const Beginning& from, Simulation sim)
{
    return {.folder = from.folder,
            .case_text = {},
            .sim = std::move(sim),
            .comm = from.comm,
            .ranks = from.ranks};
}

Progress progress_of(const Beginning& from, double time)
{
    return {from.folder, from.options.quiet ? Verbosity::quiet : Verbosity::normal, time};
}

// Files of a new run, before anything is computed.
FolderLock begin_folder(const Beginning& from, const std::string& case_text, const Filling& filling)
{
    keep_the_case(from.options, from.folder, case_text);
    check_disk(from.folder, from.scene, from.plan);
    FolderLock lock =
        prepare_results(from.folder, from.options.force ? Existing::replace : Existing::refuse);
    forget_stop_request(from.folder);
    TimingBudget budget = timing_budget(from.options, from.scene, from.plan);
    budget.file = seconds_to_write(from.folder / "case.toml", case_text);
    std::optional<StepCost> timed;
    if (from.comm == nullptr) { // one process cannot time what several share
        timed = time_case({from.options.case_file, from.options.overrides}, from.scene, from.plan,
                          filling, budget);
    }
    write_text(from.folder / "plan.json", plan_json(from.scene, from.plan, timed));
    return lock;
}

// Restores the plan of the folder if the case has changed or the file is missing.
void write_case(const fs::path& folder, const Scene& scene, const Plan& plan)
{
    write_text(folder / "case.toml", to_toml(scene));
    write_text(folder / "plan.json", plan_json(scene, plan, {}));
}

// Files of a run that goes on.
void continue_folder(const Beginning& from, const Resumption& state)
{
    const Scene& scene = from.scene;
    if (!state.passed_over.empty()) {
        take_previous_checkpoint(from.folder);
    }
    change_columns(from.folder, energy_table(scene)); // of a version that wrote fewer
    if (scene.gauges.empty()) {
        set_aside(from.folder, "gauges");
    } else {
        change_columns(from.folder, gauges_table(gauge_heads(scene)));
    }
    if (!scene.open.empty()) {
        change_columns(from.folder, open_table(scene));
    }
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
    job.outputs->timer().end();
}

// Writes a frame and keeps the state as the one to return to, for which the particles of all
// processes are gathered once. Behind the first frame a checkpoint is written at once.
void write_frame(Job& job)
{
    Clock clock = job.sim.clock;
    clock.frame += 1;
    with_whole(job.sim, job.comm, [&] {
        job.outputs->write_frame(job.sim);
        job.sim.clock = clock;
        if (clock.step > 0 || job.sim.scene.time.recover) {
            keep_good_state(job);
        }
    });
    job.sim.clock = clock; // of all processes
    job.good_step = clock.step;
    if (job.ranks != nullptr) {
        job.ranks->write(job.sim);
    }
}

} // namespace

Job start(const Beginning& from, Filling filling)
{
    const std::string case_text = to_toml(from.scene);
    std::optional<FolderLock> lock;
    if (writes(from.comm)) {
        lock.emplace(begin_folder(from, case_text, filling));
    }
    Simulation sim = make_simulation(from.scene, from.plan, filling, from.comm);
    filling = {}; // as large as the state of the fluid, and no more needed
    Job job = follower(from, std::move(sim));
    with_whole(job.sim, job.comm, [&] {
        job.case_text = case_text;
        job.lock.emplace(std::move(*lock));
        job.progress = progress_of(from, 0);
        job.outputs.emplace(from.folder, job.sim, domain_of(from.scene));
        if (job.ranks != nullptr) {
            job.ranks->open(from.folder);
        }
        job.given = texts_of_given_case(from.options, from.scene);
    });
    update_outputs(job);
    write_checkpoint(job);
    return job;
}

Job resume(const Beginning& from, Resumption state, Filling filling)
{
    std::optional<FolderLock> lock;
    if (writes(from.comm)) {
        lock.emplace(prepare_results(from.folder, Existing::extend));
        forget_stop_request(from.folder);
    }
    Simulation sim = make_simulation(from.scene, from.plan, filling, from.comm);
    filling = {}; // as large as the state of the fluid, and no more needed
    restore(sim, from.comm, &state.state);
    Job job = follower(from, std::move(sim));
    job.first_step = job.good_step = job.saved_step = job.sim.clock.step;
    if (writes(from.comm)) {
        const Clock& clock = job.sim.clock;
        job.case_text = to_toml(from.scene);
        job.lock.emplace(std::move(*lock));
        job.progress = progress_of(from, clock.time);
        job.progress.line(fmt::format("resuming from t = {} s, step {}", clock.time, clock.step));
        continue_folder(from, state);
        if (!state.passed_over.empty()) {
            job.progress.line(
                fmt::format("note: {}; using the previous checkpoint", state.passed_over));
        }
        job.outputs.emplace(from.folder, job.sim, state.state);
        if (job.ranks != nullptr) {
            job.ranks->open(from.folder);
        }
        if (state.changed || !fs::exists(from.folder / "plan.json")) {
            write_case(from.folder, from.scene, from.plan);
        }
        job.given = texts_of_given_case(from.options, from.scene);
        if (from.scene.time.recover) {
            job.last_good = std::move(state.state);
        }
    }
    if (state.changed) { // or a kill would leave a checkpoint of the case before
        write_checkpoint(job);
    }
    return job;
}

void update_outputs(Job& job)
{
    Simulation& sim = job.sim;
    if (job.outputs) {
        job.outputs->log_contacts(sim);
    }
    if (history_due(sim.clock, sim.scene)) {
        const Totals now = totals(sim); // of all processes
        if (job.outputs) {
            job.outputs->write_histories(sim, now);
        }
        sim.clock.history += 1;
    }
    if (!sim.scene.gauges.empty() && gauge_due(sim.clock, sim.scene)) {
        sim.timer.begin("gauges");
        const std::vector<double> readings = next_gauge_row(sim);
        if (job.outputs) {
            job.outputs->write_gauges(sim, readings);
        }
        sim.timer.end();
        sim.clock.gauge += 1;
    }
    if (frame_due(sim.clock, sim.scene)) {
        write_frame(job);
    }
}

void write_checkpoint(Job& job)
{
    with_whole(job.sim, job.comm, [&] {
        job.outputs->timer().begin("checkpoints");
        if (!job.sim.scene.time.recover) {
            job.last_good.reset();
        }
        job.outputs->settle(); // frames on their way are nearly as large as the state
        job.outputs->write_checkpoint(state_of(job));
        job.outputs->timer().end();
    });
    job.saved_step = job.sim.clock.step;
}

} // namespace hyoryu
