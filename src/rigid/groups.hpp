// SPDX-License-Identifier: MIT
// A cluster in parts that do not meet within the step: groups whose bodies, as they move now, do
// not come near those of another group. Each is advanced on its own: an impact costs its group
// alone, and is seen by no other. What impacts made of the motion is looked at afterwards. Groups
// that might have met are put back and advanced again as one, so that no contact is missed (Mirtich
// 2000, timewarp).
#pragma once

#include "outcome.hpp"

namespace hyoryu {

/// A pair of movable bodies that the broad phase found, and how they are apart at the start.
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

/// A cluster on its way through the step.
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
/// Makes the groups. Those that have not changed keep what they did; the bodies of all others are
/// put back to the start of the step.
void regroup(const StepContext& context, Splitting& splitting);
/// Advances one group, and takes note of how its bodies come off their free paths.
void advance_group(const StepContext& context, Outcome& group, const AdvanceCluster& advance);
/// When all groups are done: joins those that might have met, and tells whether there were any.
bool join_met(const StepContext& context, Splitting& splitting);

/// Advances a cluster in groups until none has been in the way of another.
void advance_in_groups(const StepContext& context, const Cluster& cluster,
                       const AdvanceCluster& advance);

/// How far a body came off its free path over a sub-step of which it went `s`.
void note_motion(const StepContext& context, const SubStep& sub, double s);

} // namespace hyoryu
