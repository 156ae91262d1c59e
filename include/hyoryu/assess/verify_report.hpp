// SPDX-License-Identifier: MIT
// Verdicts as a table on the terminal, as JSON, as Markdown, and as tables of worst errors.
#pragma once

#include "hyoryu/assess/verdict.hpp"
#include "hyoryu/report/svg.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hyoryu {

/// The text above the results.
struct VerifyInfo {
    std::string version;
    std::string commit;
    std::string build; // type and compiler
    Tier tier = Tier::quick;
    int threads = 0; // of each run
    int jobs = 1;    // runs in parallel
    double wall_seconds = 0;
};

/// Widths of the columns that hold names, so that rows line up while they come in.
struct TableWidths {
    std::size_t benchmark = 4, run = 3, check = 5;
};
TableWidths widths_of(const std::vector<Benchmark>& benchmarks);
std::string terminal_header(const TableWidths& widths);
/// One line a check and one for each note; the cost stands in the first.
std::string terminal_rows(const TableWidths& widths, const std::string& benchmark,
                          const RunResult& run);
/// "47 passed, 0 failed, 2 known to fail": the totals.
std::string summary_line(const Tally& tally);

/// "Checks held against an experiment: 12 (8 pass), ...": the sources of the expected numbers.
std::string against_line(const Tally& tally);

/// "2 threads", or "1 threads per run, 2 parallel runs".
std::string threads_of(const VerifyInfo& info);

std::string verify_json(const std::vector<BenchmarkResult>& results, const VerifyInfo& info);

struct DrawnFigures {
    std::map<std::string, std::vector<SvgFile>> files; // by benchmark
    std::vector<std::string> notes;                    // which could not be drawn, and why
};
/// Draws every figure whose runs are all among the results. `folder`: the output folder, in which
/// the results of a run stand in <benchmark>/<run>.
DrawnFigures draw_figures(const std::vector<BenchmarkResult>& results,
                          const std::filesystem::path& folder);

/// `figures`: of the same folder.
std::string verify_markdown(const std::vector<BenchmarkResult>& results, const VerifyInfo& info,
                            const DrawnFigures& figures);

/// The documents that the summary tables make up, by file name.
std::map<std::string, std::string> summary_documents(const std::vector<BenchmarkResult>& results,
                                                     const VerifyInfo& info);

} // namespace hyoryu
