// SPDX-License-Identifier: MIT
// Predicted and measured run cost.
#pragma once

#include "hyoryu/sim/cost.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hyoryu {

/// Steps to time at the start and at the end of a run of so many: about 2 % of it together, of
/// short ones a tenth, and none of runs of less than a hundred, or without fluid.
int steps_to_time(const Plan& plan, double steps);

/// Times the steps; none if there are none to time, or if what lies beyond the end of the run goes
/// wrong. The simulation is no result any more.
std::optional<StepCost> time_steps(Simulation& sim, int steps);

/// Where a case is read from.
struct CaseSource {
    const std::filesystem::path& file;
    const std::vector<std::string>& overrides;
};

/// Adds to the cost of the first steps, so many, how the flow develops from them, or from a
/// twentieth of the run where that is more: runs the same case with the least of 2, 3 and 4 times
/// its spacing that is foretold to take at most so many seconds. Nothing where all would take
/// longer, in the end take three times as long, go wrong, or where the case cannot be at such a
/// spacing.
void foretell_development(const CaseSource& source, const Plan& plan, int first,
                          double most_seconds, StepCost& cost);

/// Of the files in the folder and below [B]; 0 if there is no such folder.
double bytes_in(const std::filesystem::path& folder);

/// What this process has spent.
struct SpentCost {
    double wall_seconds = 0; // until it was done, all included [s]
    double steps = 0;        // of them
    double memory = 0;       // largest resident memory, results.h5 included [B]
    double waiting = 0;      // share of the time in which a thread had no core [1]
};

/// Adds `cost` to the summary.json in the folder: for each effect that its plan.json names, and for
/// the run, the prediction of the plan and the measurement. Throws IoError, also when one of the
/// two is not what a run wrote.
void write_cost(const std::filesystem::path& folder, const SpentCost& spent,
                const std::optional<StepCost>& measured);

} // namespace hyoryu
