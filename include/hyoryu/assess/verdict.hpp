// SPDX-License-Identifier: MIT
// Results of benchmarks and their verdicts.
#pragma once

#include "hyoryu/assess/measure.hpp"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace hyoryu {

enum class Verdict {
    pass,
    fail,  // also a run that stopped with an error
    xfail, // failed as known, and not by more than the bound of that
    xpass, // passed although it is marked as known to fail: the mark is stale, so it counts as FAIL
    measured, // not judged in this run
};
std::string to_string(Verdict verdict);

struct CheckResult {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();
    std::string check;
    Verdict verdict = Verdict::fail;
    Comparison comparison = Comparison::equal;
    // In the unit of the value; NaN where there is none:
    double expected = none;
    double got = none;
    double allowed = none;      // absolute difference; of no meaning for a bound
    double known_within = none; // how far a known failure may be off
    std::string note;           // why nothing could be measured, or why it is known to fail
    std::string because;
    std::optional<Against> against;
};

/// Cost of a run.
struct RunCost {
    double wall_seconds = 0;   // of everything, most of it writing where a case is small
    double solver_seconds = 0; // within the steps
    double steps = 0;
    double simulated_seconds = 0;
    double microseconds_per_step() const { return steps > 0 ? 1e6 * solver_seconds / steps : 0; }
};

/// From the summary of a run that came to its end. Throws IoError.
RunCost read_cost(RunFiles& files);

struct RunResult {
    BenchmarkRun run;
    RunCost cost;
    std::string error; // why the run stopped; empty if it came to its end
    std::vector<CheckResult> checks;
};

struct BenchmarkResult {
    Benchmark benchmark;
    std::vector<RunResult> runs;
};

/// Measures and judges one check in one run that came to its end. `other`: the run that
/// `check.same_as` names; null where it names none. `draws`: other runs, the mean over which and
/// `made` is judged; null where it is judged by itself.
CheckResult judge(const Check& check, MadeRun& made, MadeRun* other = nullptr,
                  std::vector<MadeRun>* draws = nullptr);

/// All checks of a run from the results that it wrote to `results`, beside those of the runs before
/// it; they fail if `error` says why it stopped. Throws IoError if the summary cannot be read, and
/// FormulaError if a check names a run that the benchmark does not have.
RunResult judge_run(const Benchmark& benchmark, const BenchmarkRun& run,
                    const std::filesystem::path& results, const std::string& error);

/// Judged checks by the source of their expected numbers.
struct Held {
    int judged = 0, pass = 0;
};

/// Checks by their verdicts.
struct Tally {
    int pass = 0, fail = 0, xfail = 0, xpass = 0, measured = 0;
    int failed() const { return fail + xpass; }
    std::array<Held, 5> against; // by `Against`
    Held unstated;               // the file does not name their reference
};
Tally tally(const std::vector<BenchmarkResult>& results);

} // namespace hyoryu
