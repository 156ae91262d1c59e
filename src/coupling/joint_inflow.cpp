// SPDX-License-Identifier: MIT
#include "joint_inflow.hpp"

#include <algorithm>

namespace hyoryu {

double joint_inertance(double density, double path, double section)
{
    return density * path / (3 * section);
}

double inertia_drop(double last, const JointResponse& joint, double growth, double limit)
{
    const double off = joint.inertance * growth - last;
    return std::clamp(last + off / (1 + joint.inertance * joint.mobility), 0.0, limit);
}

} // namespace hyoryu
