// SPDX-License-Identifier: MIT
// Balance of the work of several processes. Their times decide, which is harmless: the bits of a
// run do not depend on the cuts.
#pragma once

#include "hyoryu/sim/simulation.hpp"

namespace hyoryu {

/// State of the balance.
struct Balance {
    long long every = 50; // steps between checks; 0: never
    double busy = 0;      // seconds of work of this rank at the last check
    long long moves = 0;  // of the cuts
    double imbalance = 1; // at the last check: most work of a rank over the mean
};

/// Where the step is one of those checked and a rank works a twentieth longer than the mean, moves
/// the cuts from the next lists on, if that makes the longest work 3 % shorter: a tile weighs its
/// list entries, in the time that its rank took for one. `busy`: seconds that this rank has worked
/// in steps, without waiting. Called by all ranks after a step.
void balance(Simulation& sim, Balance& balance, double busy);

} // namespace hyoryu
