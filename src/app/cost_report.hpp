// SPDX-License-Identifier: MIT
// Predicted and measured run cost.
#pragma once

#include "hyoryu/sim/cost.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hyoryu {

/// Steps to time at the start and at the end of a run of `steps`: about 2 % of the run together, a
/// tenth of a short run, and none of a run of less than a hundred steps or without fluid.
int steps_to_time(const Plan& plan, double steps);

/// Times the steps; none if there are none to time, or if the simulation fails beyond the end of
/// the run. The state of the simulation is not a result afterwards.
std::optional<StepCost> time_steps(Simulation& sim, int steps);

/// Where a case is read from.
struct CaseSource {
    const std::filesystem::path& file;
    const std::vector<std::string>& overrides;
};

/// Adds to the cost of the `first` steps how the cost changes as the flow develops, from them or
/// from a twentieth of the run if that is more: runs the same case at the least of 2, 3 and 4 times
/// its spacing that is predicted to take at most `most_seconds`. Nothing if all are predicted to
/// take longer, if the run takes three times as long or fails, or if the case is invalid at such a
/// spacing.
void predict_development(const CaseSource& source, const Plan& plan, int first, double most_seconds,
                         StepCost& cost);

/// Size of the files in the folder and its subfolders [B]; 0 if the folder does not exist.
double bytes_in(const std::filesystem::path& folder);

/// Resources used by this process.
struct SpentCost {
    double wall_seconds = 0; // until it was done, all included [s]
    double steps = 0;        // of them
    double memory = 0;       // largest resident memory, results.h5 included [B]
    double waiting = 0;      // share of the time in which a thread had no core [1]
};

/// Adds `cost` to the summary.json in the folder: for each effect that its plan.json names, and for
/// the run, the prediction of the plan and the measurement. Throws IoError, also if one of the two
/// files was not written by a run.
void write_cost(const std::filesystem::path& folder, const SpentCost& spent,
                const std::optional<StepCost>& measured);

} // namespace hyoryu
