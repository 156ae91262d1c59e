// SPDX-License-Identifier: MIT
// Cost and accuracy of the engines on a scene.
#pragma once

#include "engine.hpp"

namespace hyoryu::bench {

/// What one engine did on one scene at one time step. Costs are CPU time of one thread.
struct Result {
    std::string engine;
    double dt = 0;        // [s]
    long long steps = 0;  // taken; fewer than the scene's where the budget ended the run
    bool stopped = false; // by the budget
    int repeats = 0;
    double cost = 0;             // a step, mean over the run [s]
    double early_cost = 0;       // a step, over the first quarter [s]
    double late_cost = 0;        // a step, over the last quarter [s]
    int contacts = 0;            // points at the end
    std::vector<double> metrics; // measured, in the order of the scene's
};

struct Plan {
    Extent extent = Extent::quick;
    double budget = 60; // CPU time of one run after which it is stopped [s]
};

/// Runs the scene in every engine. Costs are taken in blocks of steps, in rounds over all engines,
/// and each block's least time counts, so that a machine busy with something else for a while makes
/// none of them look slow. Accuracy comes from a run of its own, so that reading states costs
/// nothing.
std::vector<Result> measure(const Scene& scene, const std::vector<Engine>& engines,
                            const Plan& plan);

} // namespace hyoryu::bench
