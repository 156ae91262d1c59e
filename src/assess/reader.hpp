// SPDX-License-Identifier: MIT
// The parts of the readers of benchmark and study files.
#pragma once

#include "hyoryu/assess/benchmark.hpp"
#include "section.hpp"

namespace hyoryu {

/// A file with its lines, and its text as TOML. Throws CaseError if it cannot be read or parsed.
struct OpenedFile {
    BenchmarkFile file;
    TomlNode document;
};
OpenedFile open_toml(const std::filesystem::path& file);

/// `[constants]`: numbers, or expressions of those before them. `[columns]`: derived columns.
Definitions read_definitions(Section& root);

/// A number or a text as a parameter; nothing, and a mistake noted under `key`, for anything else.
std::optional<RunParameter> read_parameter(BenchmarkFile& file, const TomlNode& node,
                                           const std::string& key);

/// Which rows of which file, and the expression `key` of their columns.
Series read_series(Section& section, std::string_view key);

/// The measured quantity: series, `measure` and the keys that this measure needs.
Quantity read_quantity(Section& section);

/// `expected` and `reference`; returns how many of them are there.
int read_expectation(Section& section, Expectation& expected);

/// The runs, every combination of the values of a `grid` by itself.
std::vector<BenchmarkRun> read_runs(Section& root, const Definitions& definitions, Tier tier);

/// Of a benchmark whose definitions and runs are read.
std::vector<Check> read_checks(Section& root, const Benchmark& benchmark);
std::vector<Figure> read_figures(Section& root, const std::vector<BenchmarkRun>& runs);
std::vector<SummaryTable> read_summary_tables(Section& root, const Benchmark& benchmark);

/// Patterns, each of which must fit a run; `*` if the key is not there.
std::vector<std::string> read_patterns(Section& section, std::string_view key,
                                       const std::vector<BenchmarkRun>& runs);

/// The tier named by `tier`.
Tier read_tier(Section& section, Tier fallback);

/// Every combination of one number below each count, the last one fastest.
std::vector<std::vector<int>> grid_of(const std::vector<int>& counts);

} // namespace hyoryu
