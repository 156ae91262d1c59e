// SPDX-License-Identifier: MIT
// `hyoryu verify`: runs benchmarks as `hyoryu run` does and checks their results.
#include "build_info.hpp"
#include "commands.hpp"
#include "options.hpp"
#include "stop_request.hpp"

#include "hyoryu/assess/verify_report.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/core/parallel.hpp"
#include "hyoryu/io/claim.hpp"
#include "hyoryu/io/results.hpp"
#include "hyoryu/scene/reader_hint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

/// True if a folder of `cases` is a benchmark.
bool holds_benchmarks(const fs::path& cases)
{
    std::error_code fault;
    for (const auto& entry : fs::directory_iterator(cases, fault)) {
        if (fs::exists(entry.path() / "verify.toml")) {
            return true;
        }
    }
    return false;
}

/// The folder asked for; else `cases` here, of the source tree, or of the installation.
fs::path cases_folder(const VerifyOptions& options)
{
    if (!options.cases.empty()) {
        if (!holds_benchmarks(options.cases)) {
            throw CaseError(
                fmt::format("no folder in `{}` holds a verify.toml", options.cases.string()),
                "--cases names a folder of benchmark folders");
        }
        return options.cases;
    }
    const fs::path program = fs::read_symlink("/proc/self/exe").parent_path();
    const std::array places{fs::path("cases"), fs::path(build_info::source_folder) / "cases",
                            program.parent_path() / "share" / "hyoryu" / "cases"};
    const auto* found = std::find_if(places.begin(), places.end(), holds_benchmarks);
    if (found == places.end()) {
        throw CaseError("no benchmarks found", "name their folder with --cases");
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
    } catch (const CaseError& error) {
        return error.what();
    } catch (const NumericalError& error) {
        return error.what();
    } catch (const IoError& error) {
        return error.what();
    }
}

BenchmarkResult verify_one(const VerifyOptions& options, const Benchmark& benchmark,
                           const TableWidths& widths)
{
    BenchmarkResult result{benchmark, {}};
    for (const BenchmarkRun& run : benchmark.runs) {
        const fs::path folder = options.folder / benchmark.name / run.name;
        const std::string error = run_one(options, benchmark, run, folder);
        if (stop_requested()) {
            break;
        }
        result.runs.push_back(judge_run(benchmark, run, folder, error));
        fmt::print("{}", terminal_rows(widths, benchmark.name, result.runs.back()));
        std::fflush(stdout);
    }
    return result;
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
    const auto start = std::chrono::steady_clock::now();
    const TableWidths widths = widths_of(benchmarks);
    fmt::print("{}", terminal_header(widths));
    std::vector<BenchmarkResult> results;
    for (const Benchmark& benchmark : benchmarks) {
        results.push_back(verify_one(options, benchmark, widths));
        if (stop_requested()) {
            return exit_code::interrupted;
        }
    }
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    write_reports(options, results,
                  {.version = std::string(build_info::version),
                   .commit = std::string(build_info::commit),
                   .build = fmt::format("{}, {}", build_info::type, build_info::compiler),
                   .tier = tier,
                   .threads = thread_count(),
                   .wall_seconds = wall.count()});
    const Tally count = tally(results);
    fmt::print("{}\n", against_line(count));
    fmt::print("{} in {:.3g} s; details in {}\n", summary_line(count), wall.count(),
               (options.folder / "verify.md").string());
    return count.failed() > 0 ? exit_code::failed : exit_code::done;
}

} // namespace hyoryu
