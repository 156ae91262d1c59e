// SPDX-License-Identifier: MIT
#include "study_runs.hpp"

#include "process_pool.hpp"
#include "stop_request.hpp"

#include "hyoryu/core/input_file.hpp"
#include "hyoryu/io/claim.hpp"
#include "hyoryu/io/results.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

std::string read_all(const fs::path& file)
{
    return why_unreadable(file).empty() ? bytes_of_file(file) : std::string();
}

// Beside the folder of the run, in which a run tolerates no files but its own.
fs::path asked_of(const StudyJob& job)
{
    return fmt::format("{}.asked.txt", job.folder.string());
}

// Repeats are there for their times: nothing else of them is kept, except for the plan, by which
// the next call recognises the folder as that of a run.
void keep_what_is_due(const StudyJob& job)
{
    if (job.repeat > 1) {
        remove_results_except(job.folder, [](const std::string& name) {
            return name == "summary.json" || name == "plan.json";
        });
    }
    write_text(asked_of(job), job.asked);
}

} // namespace

bool is_done(const StudyJob& job)
{
    return fs::exists(job.folder / "summary.json") && read_all(asked_of(job)) == job.asked;
}

void forget(const StudyJob& job)
{
    std::error_code none_there;
    fs::remove(asked_of(job), none_there);
}

std::vector<std::string> run_jobs(const Study& study, const std::vector<StudyRun>& runs,
                                  const std::vector<StudyJob>& jobs,
                                  const StudyJobSettings& settings)
{
    const auto tell = [&](std::size_t k, const std::string& what) {
        const StudyJob& job = jobs[k];
        fmt::print("{:>4}/{}  {}{}: {}\n", k + 1, jobs.size(), runs[job.run].run.name,
                   job.repeat > 1 ? fmt::format(" (repeat {})", job.repeat) : "", what);
        std::fflush(stdout);
    };
    std::vector<std::string> errors(jobs.size());
    ProcessPool pool(settings.side_by_side, [&](std::size_t k, const std::string& error) {
        errors[k] = error;
        if (error.empty()) {
            keep_what_is_due(jobs[k]);
        }
        tell(k, error.empty() ? "done" : "stopped: " + error.substr(0, error.find('\n')));
    });
    for (std::size_t k = 0; k < jobs.size() && !stop_requested(); ++k) {
        const StudyJob& job = jobs[k];
        const StudyRun& run = runs[job.run];
        if (is_done(job)) {
            tell(k, "already done");
            continue;
        }
        fs::create_directories(job.folder.parent_path());
        fs::remove(asked_of(job)); // the results there are about to be replaced
        pool.start({.number = k,
                    .arguments = run_arguments(
                        {.case_file = study.case_file,
                         .folder = job.folder,
                         .overrides = run.run.set,
                         .threads = run.threads > 0 ? run.threads : settings.threads}),
                    .memory = job.memory});
    }
    pool.wait_for_all();
    return stop_requested() ? std::vector<std::string>{} : errors;
}

} // namespace hyoryu
