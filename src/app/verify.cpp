// SPDX-License-Identifier: MIT
// `hyoryu verify`: runs benchmarks as `hyoryu run` does and checks their results.
#include "build_info.hpp"
#include "commands.hpp"
#include "errors.hpp"
#include "options.hpp"
#include "process_pool.hpp"
#include "stop_request.hpp"

#include "hyoryu/assess/verify_report.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/core/parallel.hpp"
#include "hyoryu/core/timer.hpp"
#include "hyoryu/io/claim.hpp"
#include "hyoryu/io/results.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/plan.hpp"
#include "hyoryu/scene/reader_hint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <string_view>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

/// The folder asked for; else `cases` here, of the source tree, or of the installation.
fs::path cases_folder(const VerifyOptions& options)
{
    if (!options.cases.empty()) {
        if (benchmark_folders(options.cases).empty()) {
            throw CaseError(
                fmt::format("no folder in `{}` contains a verify.toml", options.cases.string()),
                "--cases expects the folder that contains the benchmark folders");
        }
        return options.cases;
    }
    const fs::path program = fs::read_symlink("/proc/self/exe").parent_path();
    const std::array places{fs::path("cases"), fs::path(build_info::source_folder) / "cases",
                            program.parent_path() / "share" / "hyoryu" / "cases"};
    const auto* found = std::ranges::find_if(
        places, [](const fs::path& place) { return !benchmark_folders(place).empty(); });
    if (found == places.end()) {
        throw CaseError("no benchmarks found", "give their folder with --cases");
    }
    return *found;
}

Tier tier_asked(const std::string& name)
{
    if (const auto tier = tier_of(name)) {
        return *tier;
    }
    throw CaseError(
        fmt::format("--tier: unknown \"{}\", expected one of {}", name, quoted_list(tier_names)),
        did_you_mean(name, tier_names));
}

/// Files that `verify` writes directly into its folder, beside a folder for each benchmark.
bool is_of_verify(const std::vector<Benchmark>& benchmarks, const std::string& name)
{
    // Earlier versions drew figures as PNG.
    const std::string now = name.ends_with(".png") ? name.substr(0, name.size() - 3) + "svg" : name;
    const auto has_file = [&](const auto& items) {
        return std::ranges::any_of(items, [&](const auto& item) { return item.file == now; });
    };
    return name == "verify.json" || name == "verify.md" ||
           std::ranges::any_of(benchmarks, [&](const Benchmark& benchmark) {
               return has_file(benchmark.figures) || has_file(benchmark.tables);
           });
}

/// Runs of an earlier call are replaced one by one with --force; nothing else is removed.
void prepare(const VerifyOptions& options, const std::vector<Benchmark>& benchmarks)
{
    if (!options.json.empty()) {
        expect_own_file(options.json, {.command = "verify --json",
                                       .start = "{\n  \"version\"",
                                       .within = "\"known_to_fail\""});
    }
    std::error_code fault;
    if (fs::exists(options.folder, fault) &&
        (!fs::is_directory(options.folder, fault) || !fs::is_empty(options.folder, fault)) &&
        !options.force) {
        throw CaseError(
            fmt::format("`{}` is not empty", options.folder.string()),
            "--force replaces the results of an earlier verify, -o selects another folder");
    }
    claim_folder(options.folder, {.command = "verify", .owns = [&](const std::string& name) {
                                      return is_of_verify(benchmarks, name);
                                  }});
    for (const Benchmark& benchmark : benchmarks) {
        for (const BenchmarkRun& run : benchmark.runs) {
            expect_replaceable(options.folder / benchmark.name / run.name);
        }
    }
}

void list(const std::vector<Benchmark>& benchmarks)
{
    fmt::print("{:<24}  {:<10}  {:<8}  {:>4}  {}\n", "case", "group", "tier", "runs", "title");
    for (const Benchmark& benchmark : benchmarks) {
        for (const Tier tier : {Tier::quick, Tier::nightly, Tier::release}) {
            const auto runs =
                std::count_if(benchmark.runs.begin(), benchmark.runs.end(),
                              [tier](const BenchmarkRun& run) { return run.tier == tier; });
            if (runs > 0) {
                fmt::print("{:<24}  {:<10}  {:<8}  {:>4}  {}\n", benchmark.name, benchmark.group,
                           to_string(tier), runs, benchmark.title);
            }
        }
    }
}

/// The reason in the messages of a run that stopped: what follows "error: " at the start of a line.
std::string reason_in(const std::string& messages)
{
    constexpr std::string_view mark = "error: ";
    const std::size_t later = messages.find(fmt::format("\n{}", mark)); // behind warnings
    if (messages.starts_with(mark)) {
        return messages.substr(mark.size());
    }
    return later == std::string::npos ? messages : messages.substr(later + 1 + mark.size());
}

/// Why the run stopped; empty if it came to its end.
std::string run_one(const VerifyOptions& options, const Benchmark& benchmark,
                    const BenchmarkRun& run, const fs::path& folder)
{
    // Errors are results here: the other benchmarks go on.
    try {
        run_case({.case_file = benchmark.folder / "case.toml",
                  .folder = folder,
                  .overrides = run.set,
                  .threads = options.threads,
                  .force = fs::exists(folder),
                  .quiet = true});
        return {};
    } catch (const CaseError&) {
        return reason_in(meaning_of(std::current_exception()).message);
    } catch (const NumericalError&) {
        return reason_in(meaning_of(std::current_exception()).message);
    } catch (const IoError&) {
        return reason_in(meaning_of(std::current_exception()).message);
    }
}

/// A run of a benchmark.
struct VerifyJob {
    std::size_t number = 0; // of the benchmark
    const Benchmark* benchmark = nullptr;
    const BenchmarkRun* run = nullptr;
    fs::path folder;
};

std::vector<VerifyJob> jobs_of(const VerifyOptions& options,
                               const std::vector<Benchmark>& benchmarks)
{
    std::vector<VerifyJob> jobs;
    for (std::size_t b = 0; b < benchmarks.size(); ++b) {
        for (const BenchmarkRun& run : benchmarks[b].runs) {
            jobs.push_back(
                {b, &benchmarks[b], &run, options.folder / benchmarks[b].name / run.name});
        }
    }
    return jobs;
}

/// Judges ended runs in the order of the jobs, whatever the order of their ends, and prints the
/// rows of each.
class Judge {
public:
    Judge(const std::vector<Benchmark>& benchmarks, const std::vector<VerifyJob>& jobs)
        : jobs_(jobs), widths_(widths_of(benchmarks)), errors_(jobs.size())
    {
        for (const Benchmark& benchmark : benchmarks) {
            results_.push_back({benchmark, {}});
        }
        fmt::print("{}", terminal_header(widths_));
    }

    /// `error`: why the run stopped; empty if it reached its end.
    void ended(std::size_t number, const std::string& error)
    {
        errors_[number] = error;
        for (; next_ < jobs_.size() && errors_[next_]; ++next_) {
            const VerifyJob& job = jobs_[next_];
            std::vector<RunResult>& runs = results_[job.number].runs;
            runs.push_back(judge_run(*job.benchmark, *job.run, job.folder, *errors_[next_]));
            fmt::print("{}", terminal_rows(widths_, job.benchmark->name, runs.back()));
            std::fflush(stdout);
        }
    }

    const std::vector<BenchmarkResult>& results() const { return results_; }

private:
    const std::vector<VerifyJob>& jobs_;
    TableWidths widths_;
    std::vector<BenchmarkResult> results_;
    std::vector<std::optional<std::string>> errors_; // of the ended runs
    std::size_t next_ = 0;                           // to be judged
};

/// Runs in this process, one after the other.
void run_in_turn(const VerifyOptions& options, const std::vector<VerifyJob>& jobs, Judge& judge)
{
    for (std::size_t k = 0; k < jobs.size(); ++k) {
        const std::string error =
            run_one(options, *jobs[k].benchmark, *jobs[k].run, jobs[k].folder);
        if (stop_requested()) {
            return;
        }
        judge.ended(k, error);
    }
}

/// Forecast of the memory of a run [B]; 0 if its case has a mistake, which the run will report.
double memory_of(const VerifyJob& job)
{
    try {
        const Scene scene = read_case(job.benchmark->folder / "case.toml", job.run->set);
        return make_plan(scene, fill(scene)).memory;
    } catch (const CaseError&) {
        return 0;
    }
}

/// Threads of each of several parallel runs.
int threads_of_each(const VerifyOptions& options)
{
    return options.threads > 0 ? options.threads : std::max(1, thread_count() / options.jobs);
}

/// Runs as processes, several at a time.
void run_in_parallel(const VerifyOptions& options, const std::vector<VerifyJob>& jobs, Judge& judge)
{
    watch_for_stop();
    ProcessPool pool(options.jobs, [&](std::size_t k, const std::string& messages) {
        judge.ended(k, reason_in(messages));
    });
    for (std::size_t k = 0; k < jobs.size() && !stop_requested(); ++k) {
        const VerifyJob& job = jobs[k];
        fs::create_directories(job.folder.parent_path());
        pool.start({.number = k,
                    .arguments = run_arguments({.case_file = job.benchmark->folder / "case.toml",
                                                .folder = job.folder,
                                                .overrides = job.run->set,
                                                .threads = threads_of_each(options)}),
                    .memory = memory_of(job)});
    }
    pool.wait_for_all();
}

void write_reports(const VerifyOptions& options, const std::vector<BenchmarkResult>& results,
                   const VerifyInfo& info)
{
    const std::string json = verify_json(results, info);
    write_text(options.folder / "verify.json", json);
    if (!options.json.empty()) {
        write_text(options.json, json);
    }
    for (const auto& [file, text] : summary_documents(results, info)) {
        write_text(options.folder / file, text);
    }
    const DrawnFigures drawn = draw_figures(results, options.folder);
    for (const std::string& note : drawn.notes) {
        fmt::print("{}\n", note);
    }
    for (const auto& [benchmark, files] : drawn.files) {
        for (const SvgFile& file : files) {
            write_text(options.folder / file.name, file.text);
            fmt::print("drawn: {}\n", (options.folder / file.name).string());
        }
    }
    write_text(options.folder / "verify.md", verify_markdown(results, info, drawn));
}

} // namespace

int verify(const VerifyOptions& options)
{
    const Tier tier = tier_asked(options.tier);
    const std::vector<Benchmark> all = read_benchmarks(cases_folder(options));
    if (options.list) {
        list(options.names.empty() ? all : select(all, options.names, Tier::release));
        return exit_code::done;
    }
    const std::vector<Benchmark> benchmarks = select(all, options.names, tier);
    prepare(options, benchmarks);
    const double start = steady_seconds();
    const std::vector<VerifyJob> jobs = jobs_of(options, benchmarks);
    Judge judge(benchmarks, jobs);
    if (options.jobs > 1) {
        run_in_parallel(options, jobs, judge);
    } else {
        run_in_turn(options, jobs, judge);
    }
    if (stop_requested()) {
        return exit_code::interrupted;
    }
    const std::vector<BenchmarkResult>& results = judge.results();
    const double wall = steady_seconds() - start;
    write_reports(options, results,
                  {.version = std::string(build_info::version),
                   .commit = std::string(build_info::commit),
                   .build = fmt::format("{}, {}", build_info::type, build_info::compiler),
                   .tier = tier,
                   .threads = options.jobs > 1 ? threads_of_each(options) : thread_count(),
                   .jobs = options.jobs,
                   .wall_seconds = wall});
    const Tally count = tally(results);
    fmt::print("{}\n", against_line(count));
    fmt::print("{} in {:.3g} s; details in {}\n", summary_line(count), wall,
               (options.folder / "verify.md").string());
    return count.failed() > 0 ? exit_code::failed : exit_code::done;
}

} // namespace hyoryu
