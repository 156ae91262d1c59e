// SPDX-License-Identifier: MIT
// What a run was foretold to cost, beside what it cost.
#pragma once

#include "hyoryu/sim/cost.hpp"

#include <filesystem>
#include <optional>

namespace hyoryu {

/// Steps to time at the start and at the end of a run of so many: about 1 % of it together, and
/// none of runs too short for that, or without fluid.
int steps_to_time(const Plan& plan, double steps);

/// Times the steps; none if there are none to time, or if what lies beyond the end of the run goes
/// wrong. The simulation is no result any more.
std::optional<StepCost> time_steps(Simulation& sim, int steps);

/// Adds `cost` to the summary.json in the folder: for each effect that its plan.json names, and for
/// the run, what the plan foretold and what was measured. `seconds_per_step`: of this process.
/// Throws IoError, also when one of the two is not what a run wrote.
void write_cost(const std::filesystem::path& folder, double seconds_per_step,
                const std::optional<StepCost>& measured);

} // namespace hyoryu
