// SPDX-License-Identifier: MIT
// How easily the pressure in a joint moves the bodies beside it.
#pragma once

#include "joint_gaps.hpp"

namespace hyoryu {

/// The growth dQ/dt of the flow into the joint of one face of body b by a unit of pressure there,
/// by the masses of the bodies alone, without contacts [m4/kg]. What a unit of pressure in other
/// joints of b whose sides part does to it counts with its magnitude: all of them together must not
/// reverse the motion.
double joint_mobility(const BodyJoints& joints, const Rigid& rigid, const std::vector<Pose>& poses,
                      int b, const JointFace& face);

} // namespace hyoryu
