// SPDX-License-Identifier: MIT
// The figures of benchmarks, drawn from what the runs wrote.
#pragma once

#include "hyoryu/assess/verdict.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hyoryu {

struct DrawnFigures {
    std::map<std::string, std::vector<std::string>> files; // by benchmark
    std::vector<std::string> notes;                        // which could not be drawn, and why
};

/// Draws every figure whose runs are all among the results. `folder`: the output folder, in which
/// the results of a run stand in <benchmark>/<run>.
DrawnFigures draw_figures(const std::vector<BenchmarkResult>& results,
                          const std::filesystem::path& folder);

} // namespace hyoryu
