// SPDX-License-Identifier: MIT
// From the files of the runs of a study to errors, orders, fits and the cheapest settings.
#pragma once

#include "hyoryu/assess/fit.hpp"
#include "hyoryu/assess/study.hpp"
#include "hyoryu/assess/verdict.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hyoryu {

/// One quantity in one run; NaN where there is none, and why.
struct StudyValue {
    double value = 0;
    double expected = 0; // of no meaning for measures that are differences
    double error = 0;    // relative to its scale, not negative [1]
    /// The run that stands for the exact answer, for Against::finest.
    std::optional<std::size_t> finest;
    std::string why;
};

struct StudyRunResult {
    StudyRun run;
    std::string error; // why the run stopped; empty if it came to its end
    RunCost cost;
    double work = 0;                // deterministic cost, in `StudyResult::work_unit`
    std::vector<double> walls;      // seconds within the steps, of each repeat
    std::vector<StudyValue> values; // of each quantity
};

/// One quantity along one sweep, the other sweeps held at `others`.
struct StudySeries {
    std::size_t sweep = 0, quantity = 0;
    std::string others;            // "step=0.001" of the other sweeps; empty if there are none
    std::vector<std::size_t> runs; // from coarse to fine
    // Of the error against the swept number, which falls with it for `Finest::smallest`:
    std::optional<Power> order;              // positive if the error falls towards the finest
    std::vector<double> rungs;               // the order from each run to the next
    std::optional<PowerWithFloor> to_floor;  // order and floor together
    std::optional<Power> by_work;            // exponent of the error in the work
    std::optional<PowerWithFloor> floor;     // of the error in the work
    std::optional<Richardson> extrapolation; // without an exact answer
};

struct StudyResult {
    Study study;
    std::string work_unit;
    std::vector<StudyRunResult> runs;
    std::vector<StudySeries> series;
};

/// Measures every quantity in every run. `folders` and `errors` are of the runs of `runs_of`;
/// `walls` the seconds of all repeats. Throws IoError and FormulaError.
StudyResult evaluate_study(const Study& study, const std::vector<std::filesystem::path>& folders,
                           const std::vector<std::string>& errors,
                           const std::vector<std::vector<double>>& walls);

/// Runs than which no other is both cheaper and more accurate in this quantity, cheapest first.
/// Errors against different runs cannot be compared: without an exact answer, only runs with the
/// same reference as the first run.
std::vector<std::size_t> frontier(const StudyResult& result, std::size_t quantity);

/// The cheapest run whose error is at most `target`; none if no run reaches it.
std::optional<std::size_t> cheapest(const StudyResult& result, std::size_t quantity, double target);

/// The targets of the table of cheapest settings.
inline constexpr std::array<double, 3> study_targets{0.05, 0.01, 0.005};

} // namespace hyoryu
