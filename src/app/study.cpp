// SPDX-License-Identifier: MIT
// `hyoryu study`: runs a case over values of its keys and compares accuracy with cost.
#include "build_info.hpp"
#include "commands.hpp"
#include "options.hpp"
#include "stop_request.hpp"
#include "study_runs.hpp"

#include "hyoryu/assess/study_page.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/io/claim.hpp"
#include "hyoryu/io/results.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

// Every run is read and planned before the first one starts: a mistake shows at once.
std::vector<double> forecast_memory(const Study& study, const std::vector<StudyRun>& runs)
{
    std::vector<double> memory;
    std::vector<Diagnostic> mistakes;
    for (const StudyRun& run : runs) {
        try {
            const Scene scene = read_case(study.case_file, run.run.set);
            memory.push_back(make_plan(scene, fill(scene)).memory);
        } catch (const CaseError& error) {
            for (Diagnostic mistake : error.diagnostics()) {
                mistake.what = fmt::format("{} (in the run {})", mistake.what, run.run.name);
                mistakes.push_back(std::move(mistake));
            }
        }
    }
    if (!mistakes.empty()) {
        throw CaseError(mistakes);
    }
    return memory;
}

// The case as resolved, so that a result of another version of it is not taken for this one.
std::string asked_of(const Study& study, const StudyRun& run, int threads)
{
    return fmt::format("{}\nthreads {}\n", to_toml(read_case(study.case_file, run.run.set)),
                       run.threads > 0 ? run.threads : threads);
}

// Rounds of all runs, so that a machine that slows down for a while slows all of them.
std::vector<StudyJob> jobs_of(const Study& study, const std::vector<StudyRun>& runs,
                              const StudyOptions& options, const fs::path& folder)
{
    const std::vector<double> memory = forecast_memory(study, runs);
    std::vector<StudyJob> jobs;
    for (int repeat = 1; repeat <= study.repeats; ++repeat) {
        for (std::size_t k = 0; k < runs.size(); ++k) {
            const fs::path place =
                repeat == 1 ? folder / "runs" / runs[k].run.name
                            : folder / "repeats" / fmt::format("{}-{}", runs[k].run.name, repeat);
            jobs.push_back(
                {k, repeat, place, asked_of(study, runs[k], options.threads), memory[k]});
        }
    }
    return jobs;
}

double seconds_within_steps(const fs::path& folder)
{
    RunFiles files(folder, {});
    return read_cost(files).solver_seconds;
}

StudyResult collect_results(const Study& study, const std::vector<StudyRun>& runs,
                            const std::vector<StudyJob>& jobs,
                            const std::vector<std::string>& job_errors)
{
    std::vector<fs::path> folders(runs.size());
    std::vector<std::string> errors(runs.size());
    std::vector<std::vector<double>> walls(runs.size());
    for (std::size_t j = 0; j < jobs.size(); ++j) {
        const StudyJob& job = jobs[j];
        if (job.repeat == 1) {
            folders[job.run] = job.folder;
            errors[job.run] = job_errors[j];
        }
        if (job_errors[j].empty()) {
            walls[job.run].push_back(seconds_within_steps(job.folder));
        }
    }
    return evaluate_study(study, folders, errors, walls);
}

void write_results(const StudyResult& result, const StudyInfo& info, const fs::path& folder)
{
    write_text(folder / "study.csv", study_csv(result));
    write_text(folder / "study.json", study_json(result, info));
    const StudyPictures pictures = draw_study(result);
    for (const std::string& note : pictures.notes) {
        fmt::print("{}\n", note);
    }
    for (const SvgFile& picture : pictures.files) {
        write_text(folder / picture.name, picture.text);
    }
    write_text(folder / "study.md", study_markdown(result, info, pictures.files));
    write_text(folder / "study.html", study_page(result, info, pictures.files));
}

void print_tables(const StudyResult& result)
{
    for (const StudyTable& table : study_tables(result)) {
        fmt::print("\n{}\n{}", table.title, terminal_table(table.table));
    }
}

// Files that a study writes directly into its folder.
bool is_of_study(const std::string& name)
{
    constexpr std::array<std::string_view, 6> names{"study.csv",  "study.json", "study.md",
                                                    "study.html", "runs",       "repeats"};
    return std::ranges::find(names, name) != names.end() ||
           (name.starts_with("study_") && (name.ends_with(".svg") || name.ends_with(".png")));
}

// Nothing is removed before it is certain that no file of the user is in the way. With --force
// finished runs are not reused: each run replaces its own folder.
void prepare(const StudyOptions& options, const std::vector<StudyJob>& jobs, const fs::path& folder)
{
    claim_folder(folder, {.command = "study", .owns = is_of_study});
    for (const StudyJob& job : jobs) {
        if (options.force) {
            forget(job);
        }
        if (!is_done(job)) {
            expect_replaceable(job.folder);
        }
    }
}

} // namespace

int run_study(const StudyOptions& options)
{
    watch_for_batch_signal();
    const Study study = read_study(options.file);
    const fs::path folder = options.folder.empty()
                                ? fs::path(options.file.stem().string() + "-results")
                                : options.folder;
    const std::vector<StudyRun> runs = runs_of(study);
    const std::vector<StudyJob> jobs = jobs_of(study, runs, options, folder);
    prepare(options, jobs, folder);
    const FolderLock lock(folder);
    watch_for_stop();
    const std::vector<std::string> errors =
        run_jobs(study, runs, jobs, {.threads = options.threads, .side_by_side = options.jobs});
    if (stop_requested()) {
        fmt::print("stopped; run the same command again to continue\n");
        return exit_code::interrupted;
    }
    const StudyResult result = collect_results(study, runs, jobs, errors);
    write_results(result,
                  {.version = std::string(build_info::version),
                   .commit = std::string(build_info::commit),
                   .build = fmt::format("{}, {}", build_info::type, build_info::compiler),
                   .threads = options.threads,
                   .jobs = options.jobs},
                  folder);
    print_tables(result);
    fmt::print("\nresults in {}\n", (folder / "study.html").string());
    const bool all_well = std::ranges::all_of(errors, &std::string::empty);
    return all_well ? exit_code::done : exit_code::numbers;
}

} // namespace hyoryu
