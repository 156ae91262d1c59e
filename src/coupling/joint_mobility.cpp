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

class JointPushes {
public:
    JointPushes(const BodyJoints& joints, const std::vector<Pose>& poses, int b)
        : joints_(joints), poses_(poses), b_(b)
    {
    }

    // Of the joint of one face, those of body b first; none if its sides do not part.
    std::vector<UnitPush> operator()(const JointFace& face) const
    {
        std::vector<UnitPush> pushes{{b_, {}}};
        double opening = 0;
        for (int c = face.first; c < face.last; ++c) {
            const JointNode& node = joints_.nodes[at(c)];
            if (node.other == JointNode::none) {
                continue;
            }
            const double area = joints_.faces.cells[at(c)].area;
            opening += area * node.opening;
            add(pushes, b_, -area * node.normal, node.place);
            if (node.other >= 0) {
                add(pushes, node.other, area * node.normal, node.place);
            }
        }
        return opening > 0 ? pushes : std::vector<UnitPush>{};
    }

private:
    void add(std::vector<UnitPush>& pushes, int body, const Vec3& force, const Vec3& place) const
    {
        auto known = std::ranges::find(pushes, body, &UnitPush::body);
        if (known == pushes.end()) {
            known = pushes.insert(known, {body, {}});
        }
        known->wrench.force += force;
        known->wrench.torque += (place - poses_[at(body)].position).cross(force);
    }

    const BodyJoints& joints_;
    const std::vector<Pose>& poses_;
    int b_;
};

} // namespace

void find_mobilities(BodyJoints& joints, const Rigid& rigid, const std::vector<Pose>& poses, int b)
{
    const std::size_t faces = joints.faces.faces.size();
    const JointPushes pushes_of(joints, poses, b);
    std::vector<std::vector<UnitPush>> pushes(faces);
    for (std::size_t f = 0; f < faces; ++f) {
        if (joints.joined[f] != 0) {
            pushes[f] = pushes_of(joints.faces.faces[f]);
        }
    }
    for (std::size_t f = 0; f < faces; ++f) {
        double& mobility = joints.inflows[f].mobility;
        mobility = 0;
        for (const UnitPush& push : pushes[f]) {
            const Acceleration motion = acceleration(rigid.bodies[at(push.body)], push.wrench);
            if (push.body != b) {
                mobility += growth_of_flow(push.wrench, motion);
                continue;
            }
            for (const std::vector<UnitPush>& other : pushes) {
                mobility +=
                    other.empty() ? 0 : std::abs(growth_of_flow(other.front().wrench, motion));
            }
        }
    }
}

} // namespace hyoryu
