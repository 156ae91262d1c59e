// SPDX-License-Identifier: MIT
// What the step of a cluster did, apart from what the steps of others do.
#pragma once

#include "sub_step.hpp"

#include <functional>

namespace hyoryu {

/// Advances the bodies of a cluster by the whole step with all its pairs.
using AdvanceCluster = std::function<void(const StepContext&, const Cluster&)>;

/// A cluster, or a part of one, and what its step did beside the motion of its bodies.
struct Outcome {
    Cluster cluster;
    bool done = false;
    bool jammed = false;
    RigidCounters counters;
    std::vector<Contact> log;
    std::vector<Remembered> fresh;
};

/// Advances the cluster of an outcome, which gets all that the step hands on.
void advance_apart(const StepContext& context, Outcome& outcome, const AdvanceCluster& advance);

/// Adds an outcome to what the step of all bodies hands on.
void hand_over(const StepContext& context, const Outcome& outcome);

} // namespace hyoryu
