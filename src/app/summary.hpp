// SPDX-License-Identifier: MIT
// `summary.json`: the results, diagnostics and cost of a run.
#pragma once

#include "hyoryu/io/results.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <string>

namespace hyoryu {

/// Largest resident memory of this process so far [B].
double peak_memory();

/// Of a run that several processes shared; see rank_log.hpp.
struct RankSummary;

/// `exit_reason`: "done", "interrupted", "until", "numerical error", "too many particles", "io
/// error". `first_step`: step at which this process began; `output`: time of the solver thread by
/// kind of output; `frames`: cost of the writer thread; `ranks`: null for one process.
std::string summary_json(const Simulation& sim, const std::string& exit_reason, double wall_seconds,
                         std::int64_t first_step, const StageTimer& output,
                         const FrameWriter::Cost& frames, const RankSummary* ranks);

} // namespace hyoryu
