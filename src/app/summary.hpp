// SPDX-License-Identifier: MIT
// `summary.json`: the results, diagnostics and cost of a run.
#pragma once

#include "rank_log.hpp"

#include "hyoryu/io/results.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <optional>
#include <string>

namespace hyoryu {

/// Largest resident memory of this process so far [B].
double peak_memory();

/// The state at the end, of all processes that share the run.
struct Closing {
    Totals totals;
    Index fluid = 0;                       // particles
    Index in_solids = 0;                   // those of them that are inside a wall or body
    double pair_visits = 0;                // of all processes since the last restart
    std::optional<RankSummary> ranks = {}; // none for one process
};

/// `exit_reason`: "done", "interrupted", "until", "numerical error", "too many particles", "io
/// error". `first_step`: step at which this process began; `output`: time of the solver thread by
/// kind of output; `frames`: cost of the writer thread.
std::string summary_json(const Simulation& sim, const Closing& now, const std::string& exit_reason,
                         double wall_seconds, std::int64_t first_step, const StageTimer& output,
                         const FrameWriter::Cost& frames);

} // namespace hyoryu
