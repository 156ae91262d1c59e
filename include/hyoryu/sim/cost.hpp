// SPDX-License-Identifier: MIT
// Measurement of the cost of a step on this machine, of the share of each effect, and of the change
// of both with the development of the flow.
#pragma once

#include "hyoryu/sim/simulation.hpp"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hyoryu {

/// Change of the cost of a run relative to its first steps, measured on the same scene with fewer
/// particles. The frequency of list making and the contacts of bodies follow the flow: at any
/// resolution a step moves particles by the same share of a spacing.
struct Development {
    double coarsening = 1; // its spacing over that of the case
    double steps = 1;      // its steps over those that its plan expects
    double step = 1;       // a step without bodies and lists, on average, over one of the first
    double builds = 0;     // of lists, in a step on average
    double seconds = 0;    // that it took
    double slowdown = 1;   // its steps over what they take without stalls
    double fluid = 1;      // share of its fluid that is left, on average over the run [1]
    double fluid_end = 1;  // and at its end [1]
    double impacts = 0;    // of its bodies, which are those of the case
};

/// The wall time of a step, and the share of it that goes with each effect that can be left out.
struct StepCost {
    struct Share {
        std::string effect; // as the plan names it
        double share = 0;   // of a step, median over the rounds; not below 0 [1]
        double spread = 0;  // half of the interquartile range of the rounds, at least -median [1]
    };
    double seconds = 0; // of a step with everything on, on average, without stalls [s]
    double bodies = 0;  // of them, for the motion of bodies and their contacts [s]
    double lists = 0;   // of them, for making lists, which some steps do [s]
    double build = 0;   // for making them once [s]
    double row = 0;     // of the sums of a row of the histories [s]
    double output = 0;  // mean additional time of a step for output, over the run [s]
    double impacts = 0; // rows of contacts.csv of kind impact, over the whole run
    double waiting = 0; // share of the timing in which a thread had no core: a busy machine [1]
    // The timed steps over what they take without stalls, in which other work has the cores [1].
    double slowdown = 1;
    std::vector<Share> effects;
    std::optional<Development> development;
};

/// The share of an effect and its spread, from those that single rounds found.
StepCost::Share share_of(std::string effect, std::vector<double> rounds);

/// The mean of durations of steps, one after the other, without stalls: the mean of the medians of
/// runs of a few. A stall is longer than most steps and rarer, so that it moves no median, while
/// steps that grow with the flow do [s].
double mean_without_stalls(std::span<const double> seconds);

/// The mean wall time of a step over the run [s], including output: that of the timed steps, if the
/// development of the flow is unknown. On a machine as busy as it was while the steps were timed.
double seconds_of_run(const StepCost& cost);

/// Times about `steps` steps of a simulation with fluid, up to four times as many if they take less
/// than 0.05 s, in at least two rounds: in each round one
/// step with all effects, and one without each optional effect. The cost of an effect is the time
/// of the full step minus that of the step without it in the same round, not counting list
/// building, which only some steps do; consecutive steps of one state, so that a busy machine
/// disturbs all alike. The simulation continues from its present state, beyond its end, and is not
/// a result afterwards. Throws NumericalError like step().
StepCost measure_cost(Simulation& sim, int steps);

/// Reads a clock [s]; only differences count.
using Stopwatch = std::function<double()>;

/// Runs a simulation of bodies alone until its end, or until `goes_on`, called before each step,
/// returns false, and times each step. None if it fails, or if it is stopped while its steps still
/// become slower, as those of a heap on which more bodies fall: then the later ones cannot be
/// predicted.
std::optional<StepCost> measure_bodies(Simulation& sim, const std::function<bool()>& goes_on,
                                       const Stopwatch& now = steady_seconds);

/// Seconds that the sums of one row of the histories take, besides its text: the energies are added
/// up for the row, and to see whether a run gains energy [s].
double measure_row(const Simulation& sim);

/// Runs a simulation with fluid to its end and compares all its steps with the `first` steps of the
/// same scene begun `again`, taken between them: memory and threads are as warm, and other work of
/// the machine lengthens both. None if it fails, or if `goes_on`, called before each step, returns
/// false first. `coarsening` is left to the caller.
std::optional<Development> measure_development(Simulation& sim, Simulation& again, int first,
                                               const std::function<bool()>& goes_on);

} // namespace hyoryu
