// SPDX-License-Identifier: MIT
// Verdicts as a table on the terminal, as JSON, as Markdown, and as tables of worst errors.
#pragma once

#include "hyoryu/assess/verdict.hpp"

#include <map>
#include <string>
#include <vector>

namespace hyoryu {

/// What stands above the results.
struct VerifyInfo {
    std::string version;
    std::string commit;
    std::string build; // type and compiler
    Tier tier = Tier::quick;
    int threads = 0;
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
/// "47 passed, 0 failed, 2 known to fail": what counts.
std::string summary_line(const Tally& tally);

/// "Checks held against an experiment: 12 (8 pass), ...": what the judged numbers come from.
std::string against_line(const Tally& tally);

std::string verify_json(const std::vector<BenchmarkResult>& results, const VerifyInfo& info);
/// `figures`: pictures in the same folder, by benchmark.
std::string verify_markdown(const std::vector<BenchmarkResult>& results, const VerifyInfo& info,
                            const std::map<std::string, std::vector<std::string>>& figures);

/// The documents that the summary tables make up, by file name.
std::map<std::string, std::string> summary_documents(const std::vector<BenchmarkResult>& results,
                                                     const VerifyInfo& info);

} // namespace hyoryu
