// SPDX-License-Identifier: MIT
#include "joint_mobility.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// What a pressure of 1 Pa in a joint does to one of its two sides.
struct UnitPush {
    int body = 0;
    Wrench wrench; // [m2], [m3]
};

double growth_of_flow(const Wrench& wrench, const Acceleration& motion)
{
    return wrench.force.dot(motion.linear) + wrench.torque.dot(motion.angular);
}

void add(Wrench& wrench, const Vec3& force, const Vec3& place, const Pose& pose)
{
    wrench.force += force;
    wrench.torque += (place - pose.position).cross(force);
}

// Calls visit(node, area) for the cells of a joint.
void for_each_cell(const BodyJoints& joints, const JointFace& face, const auto& visit)
{
    for (int c = face.first; c < face.last; ++c) {
        const JointNode& node = joints.nodes[at(c)];
        if (node.other != JointNode::none) {
            visit(node, joints.faces.cells[at(c)].area);
        }
    }
}

// On body b by one of its joints; none if its sides do not part.
Wrench own_push(const BodyJoints& joints, const Pose& pose, const JointFace& face)
{
    Wrench wrench;
    double flow = 0;
    for_each_cell(joints, face, [&](const JointNode& node, double area) {
        flow += area * node.opening;
        add(wrench, -area * node.normal, node.place, pose);
    });
    return flow > 0 ? wrench : Wrench{};
}

// On the bodies on the other side.
std::vector<UnitPush> other_pushes(const BodyJoints& joints, const std::vector<Pose>& poses,
                                   const JointFace& face)
{
    std::vector<UnitPush> pushes;
    for_each_cell(joints, face, [&](const JointNode& node, double area) {
        if (node.other < 0) {
            return;
        }
        auto known = std::ranges::find(pushes, node.other, &UnitPush::body);
        if (known == pushes.end()) {
            known = pushes.insert(known, {node.other, {}});
        }
        add(known->wrench, area * node.normal, node.place, poses[at(node.other)]);
    });
    return pushes;
}

} // namespace

double joint_mobility(const BodyJoints& joints, const Rigid& rigid, const std::vector<Pose>& poses,
                      int b, const JointFace& face)
{
    double mobility = 0;
    for (const UnitPush& push : other_pushes(joints, poses, face)) {
        mobility +=
            growth_of_flow(push.wrench, acceleration(rigid.bodies[at(push.body)], push.wrench));
    }
    const Pose& pose = poses[at(b)];
    const Acceleration motion = acceleration(rigid.bodies[at(b)], own_push(joints, pose, face));
    for (std::size_t f = 0; f < joints.faces.faces.size(); ++f) {
        if (joints.joined[f] != 0) {
            const Wrench its = own_push(joints, pose, joints.faces.faces[f]);
            mobility += std::abs(growth_of_flow(its, motion));
        }
    }
    return mobility;
}

} // namespace hyoryu
