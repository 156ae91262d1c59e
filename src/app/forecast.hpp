// SPDX-License-Identifier: MIT
// Predicted cost of a run, from a short timing on this machine.
#pragma once

#include "cost_report.hpp"

#include "hyoryu/scene/disk.hpp"

#include <optional>

namespace hyoryu {

/// How much may be timed before a run.
struct TimingBudget {
    int steps = 0;       // of a run with fluid, at its start
    double part = 0;     // of the run, for the look at how it develops [1]
    double least = 0;    // and at least so long, but of short runs no more than 15 % or 0.1 s [s]
    double most = 0;     // and at most [s]
    double part_run = 1; // of the case that is run [1]
    double file = 1e-3;  // to write a small file [s]
};

/// Seconds that it takes to write a small file into the folder, and to know that it is there: the
/// median of a few [s]. The file is left there.
double seconds_to_write(const std::filesystem::path& file, const std::string& text);

/// Times the case on simulations of their own, which are gone afterwards. With fluid: some of the
/// first steps, and the whole with fewer particles. Bodies alone: as many steps as the budget
/// allows. None if no prediction is possible, as of a scene that becomes unstable at once.
std::optional<StepCost> time_case(const CaseSource& source, const Scene& scene, const Plan& plan,
                                  const Filling& filling, const TimingBudget& budget);

/// Steps that the plan and the timing expect.
double expected_steps(const Plan& plan, const std::optional<StepCost>& timed);

/// The course that the plan and the timing expect.
Course expected_course(const Plan& plan, const std::optional<StepCost>& timed);

/// Wall time of gauges, over the whole run [s].
double gauge_seconds(const Plan& plan);

/// Wall time of the run [s]; from fixed rates, an order of magnitude, if nothing was timed, as with
/// several processes.
double wall_forecast(const Plan& plan, const std::optional<StepCost>& timed, int processes = 1);

} // namespace hyoryu
