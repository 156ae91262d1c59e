// SPDX-License-Identifier: MIT
// What the films between a body and the solid under it push along their joint.
//
// Water beside a standing body pushes, besides its side, the ground under it. The films between the
// body and the ground before it push the body as much, by the symmetry of the two corners, so that
// it has the whole force of the water. The films between the body and the ground under it must push
// nothing along the joint. They would, since the pressure of solid particles ends where fluid is
// out of reach, and the particles of the body reach fluid farther in than those of the ground: as
// -0.2 to 0.25 spacings of height of the water would, by the place of its last column, 5 % of the
// force at ten spacings. The force of a film is that of fluid/pressure. Ours.
#pragma once

#include "joint_gaps.hpp"

namespace hyoryu {

/// Removes from the forces on the particles behind joints (`Fluid::film_cuts`), in the measure in
/// which the joint replaces their films, what the films with particles opposite the joint push
/// along it, and adds it to what the other side gets back. Joints beside bodies keep their films: a
/// piston that fills its tube was 1.4 % too heavy without. So do particles beside a joint: under an
/// overhang the fluid pushes the body towards its support, as much as these films push it away.
void cut_slip_of_films(JointTables& tables, const std::vector<Pose>& poses, Fluid& fluid);

} // namespace hyoryu
