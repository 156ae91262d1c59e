// SPDX-License-Identifier: MIT
// The parts of the reader of benchmark files.
#pragma once

#include "hyoryu/assess/read.hpp"

namespace hyoryu {

/// The runs, every combination of the values of a `grid` by itself.
std::vector<BenchmarkRun> read_runs(Section& root, const Constants& constants, Tier tier);

/// Of a benchmark whose constants and runs are read.
std::vector<Check> read_checks(Section& root, const Benchmark& benchmark);
std::vector<Figure> read_figures(Section& root, const std::vector<BenchmarkRun>& runs);
std::vector<SummaryTable> read_summary_tables(Section& root, const Benchmark& benchmark);

/// Patterns, each of which must fit a run.
std::vector<std::string> read_patterns(Section& section, std::string_view key,
                                       const std::vector<BenchmarkRun>& runs);

/// The tier named by `tier`.
Tier read_tier(Section& section, Tier fallback);

} // namespace hyoryu
