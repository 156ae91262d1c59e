// SPDX-License-Identifier: MIT
// Splits a cluster into groups of bodies that are not expected to meet within the step. Each group
// is advanced on its own, so that an impact costs only its group. Afterwards the actual motion is
// checked: groups that might have met are reset to the start of the step and advanced again as one,
// so that no contact is missed (Mirtich 2000, timewarp).
#pragma once

#include "outcome.hpp"

namespace hyoryu {

/// A pair of movable bodies from the broad phase, and their separation at the start of the step.
struct Link {
    int a = 0, b = 0;
    Vec3 normal{0, 0, 1};   // from b to a
    double gap = -infinity; // along it [m]
    double shift = 0;       // least change of the gap on the free paths, of the centres of mass [m]
};

/// Where bodies are at the start of the step, in the order of their cluster.
struct ClusterStart {
    std::vector<SolidPose> poses;
    std::vector<Vec3> velocities; // [m/s]
    std::vector<Vec3> momenta;    // angular [kg m2/s]
};

/// The state of a cluster that is advanced in groups.
struct Splitting {
    const Cluster* cluster = nullptr;
    std::vector<Link> links;
    bool whole = false; // it is one group
    ClusterStart start; // if it is more than one
    std::vector<Outcome> groups;
    int repetition = 0;
    bool open = true; // groups may still meet
};

/// Splits a cluster by how its bodies move now.
Splitting split(const StepContext& context, const Cluster& cluster);
/// Forms the groups. Unchanged groups keep their outcome; the bodies of all others are reset to the
/// start of the step.
void regroup(const StepContext& context, Splitting& splitting);
/// Advances one group and records the deviation of its bodies from their free paths.
void advance_group(const StepContext& context, Outcome& group, const AdvanceCluster& advance);
/// Joins the groups that might have met; returns whether there were any. Called when all are done.
bool join_met(const StepContext& context, Splitting& splitting);

/// Advances a cluster in groups until no two groups might have met.
void advance_in_groups(const StepContext& context, const Cluster& cluster,
                       const AdvanceCluster& advance);

/// Records the deviation of bodies from their free paths over the time `s` of a sub-step.
void note_motion(const StepContext& context, const SubStep& sub, double s);

} // namespace hyoryu
