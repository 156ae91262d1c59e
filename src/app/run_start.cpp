// SPDX-License-Identifier: MIT
// The start of a run: the folder and its files, the simulation, and the first output.
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
#include "hyoryu/sim/gauges.hpp"
#include "hyoryu/sim/state_parts.hpp"

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

// Refuses to overwrite the case: it may lie in the folder under the name of the copy that a run
// makes.
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

Groups groups_of(const Beginning& from)
{
    return from.comm == nullptr ? Groups{} : group_ranks(from.comm->size(), from.options.parts);
}

// The job of a process that does not write.
Job follower(const Beginning& from, Simulation sim)
{
    return {.folder = from.folder,
            .case_text = {},
            .sim = std::move(sim),
            .comm = from.comm,
            .ranks = from.ranks,
            .groups = groups_of(from)};
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
    const int processes = from.comm == nullptr ? 1 : from.comm->size();
    write_text(from.folder / "plan.json", plan_json(from.scene, from.plan, timed, processes));
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

// Puts the state of a checkpoint into the simulation, and returns the data that do not belong to
// particles.
Snapshot take_up(const Beginning& from, Resumption& found, Simulation& sim)
{
    if (from.comm == nullptr && found.parts.empty()) {
        restore(sim, found.state);
        return std::move(found.state);
    }
    StateParts state;
    if (found.parts.empty()) {
        state = one_part(sim, std::move(found.state));
    } else {
        state.common = std::move(found.state);
        state.count = static_cast<int>(found.parts.size());
        state.particles = [&](int part) {
            return read_checkpoint_part(from.folder, found.parts[static_cast<std::size_t>(part)]);
        };
    }
    restore(sim, from.comm, state);
    return std::move(state.common);
}

} // namespace

Job start(const Beginning& from, Filling filling)
{
    const std::string case_text = to_toml(from.scene);
    std::optional<FolderLock> lock;
    if (writes(from.comm)) {
        lock.emplace(begin_folder(from, case_text, filling));
    }
    any_wishes<1>(from.comm, {false}); // none writes to the folder before it is ready
    Simulation sim = make_simulation(from.scene, from.plan, std::move(filling), from.comm);
    Job job = follower(from, std::move(sim));
    if (writes(from.comm)) {
        job.case_text = case_text;
        job.lock.emplace(std::move(*lock));
        job.progress = progress_of(from, 0);
        job.outputs.emplace(from.folder, job.sim);
        if (job.ranks != nullptr) {
            job.ranks->open(from.folder);
        }
        job.given = texts_of_given_case(from.options, from.scene);
    }
    job.frames.emplace(from.folder, job.comm, job.groups);
    job.frames->write_static(job.sim, domain_of(from.scene));
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
    Simulation sim = make_to_restore(from.scene, from.plan, std::move(filling), from.comm);
    const Snapshot common = take_up(from, state, sim);
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
        job.outputs.emplace(from.folder, job.sim, &common);
        if (job.ranks != nullptr) {
            job.ranks->open(from.folder);
        }
        if (state.changed || !fs::exists(from.folder / "plan.json")) {
            write_case(from.folder, from.scene, from.plan);
        }
        job.given = texts_of_given_case(from.options, from.scene);
    }
    job.frames.emplace(from.folder, job.comm, job.groups);
    job.frames->forget_after(job.sim.clock.time); // behind the histories, which may refuse
    if (const auto gone = job.frames->missing(); !gone.empty()) {
        job.progress.line(fmt::format("warning: frames of the earlier run are missing, {} in all, "
                                      "first `{}`; the series still list them",
                                      gone.size(), gone.front().string()));
    }
    if (from.scene.time.recover) {
        keep_good_state(job);
    }
    if (state.changed) { // or a kill would leave a checkpoint of the case before
        write_checkpoint(job);
    }
    return job;
}

} // namespace hyoryu
