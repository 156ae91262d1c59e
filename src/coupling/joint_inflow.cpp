// SPDX-License-Identifier: MIT
#include "joint_inflow.hpp"

#include <algorithm>

namespace hyoryu {

double joint_inertance(double density, double path, double section)
{
    return density * path / (3 * section);
}

double inertia_drop(const JointInflow& joint, double inertance, double growth, double pressure)
{
    const double off = inertance * growth - joint.drop;
    return std::clamp(joint.drop + off / (1 + inertance * joint.mobility), 0.0, pressure);
}

} // namespace hyoryu
