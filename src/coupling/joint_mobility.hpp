// SPDX-License-Identifier: MIT
// How easily the pressure in a joint moves the bodies beside it.
#pragma once

#include "joint_gaps.hpp"

namespace hyoryu {

/// Sets the mobility of the joints of body b whose sides part (`JointInflow::mobility`), without
/// contacts. What a unit of pressure in its other joints does counts with its magnitude: all of
/// them together must not reverse the motion.
void find_mobilities(BodyJoints& joints, const Rigid& rigid, const std::vector<Pose>& poses, int b);

} // namespace hyoryu
