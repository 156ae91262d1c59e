// SPDX-License-Identifier: MIT
// How much of the rim of a joint is supported, and what the water beside it pushes.
//
// The particles of a body feel fluid below its face that is not under it: beside a seam that is
// flush, the fluid beside the lower solid pushes the upper one up, as far as the kernel reaches. A
// joint that carried its pressure on its whole area would add to that. With the pressure p on both
// sides, the pairs between a column of one half space and the columns of the other add up to p per
// area, so that the fluid beyond a rim pushes p times a length T(e), where e is the distance
// between the rim of the face and that of its support, whichever goes on farther: 0.27 spacings for
// e = 0, nothing from e = 1 on but a tenth of that. This is what the joint carries less. Where the
// support goes on, no fluid is there and the joint carries the whole. Ours.
#pragma once

#include "joint_gaps.hpp"

namespace hyoryu {

/// Sets what each joined cell of body b carries (`JointNode::carried`): what the particles lack, on
/// the share of its area on which the joint acts, from where its support ends. Dry joints cast no
/// rays.
void carry_on_support(JointTables& tables, const std::vector<Pose>& poses, int b, double spacing);

/// For each cell of a face of body b the joined cell whose joint replaces the films of the
/// particles behind it: itself, or the nearest one within the support of the kernel where nothing
/// lies opposite, since the support of the face pushes the particles beside it, too. -1: none.
std::vector<int> films_of(const BodyJoints& body, const JointFace& face, double support);

} // namespace hyoryu
