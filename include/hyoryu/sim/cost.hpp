// SPDX-License-Identifier: MIT
// What a step costs on this machine, and what of it each effect takes.
#pragma once

#include "hyoryu/sim/simulation.hpp"

#include <string>
#include <vector>

namespace hyoryu {

/// The wall time of a step, and the share of it that goes with each effect that can be left out.
struct StepCost {
    struct Share {
        std::string effect; // as the plan names it
        double share = 0;   // of a step [1]; noise may take it a little below zero
    };
    double seconds = 0; // of a step with everything on, on average [s]
    std::vector<Share> effects;
};

/// Times about so many steps of a simulation with fluid, in rounds, two at least: in each one step
/// with everything, and one without each effect that the slots of the fluid can do without. What an
/// effect takes is how much less the fastest step without it needs than the fastest with it; one
/// state, one after the other, so that a busy machine disturbs all alike. The simulation goes on
/// from where it stands, beyond its end, and is no result any more. Throws NumericalError like
/// step().
StepCost measure_cost(Simulation& sim, int steps);

} // namespace hyoryu
