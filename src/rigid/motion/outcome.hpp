// SPDX-License-Identifier: MIT
// The outcome of the step of one cluster, kept apart from those of others: counters, log, contact
// forces.
#pragma once

#include "sub_step.hpp"

#include <functional>

namespace hyoryu {

/// Advances the bodies of a cluster by the whole step with all its pairs.
using AdvanceCluster = std::function<void(const StepContext&, const Cluster&)>;

/// A cluster, or a part of one, and the results of its step other than the motion of its bodies.
struct Outcome {
    Cluster cluster;
    bool done = false;
    bool jammed = false;
    RigidCounters counters;
    std::vector<Contact> log;
    std::vector<Remembered> fresh;
};

/// Advances the cluster of an outcome and stores the results in the outcome.
void advance_apart(const StepContext& context, Outcome& outcome, const AdvanceCluster& advance);

/// Adds an outcome to the results of the step of all bodies.
void hand_over(const StepContext& context, const Outcome& outcome);

} // namespace hyoryu
