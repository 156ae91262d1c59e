// SPDX-License-Identifier: MIT
// Warnings of walls so thin that the fluid acts through them.
#pragma once

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// Warns of walls that are thinner than a spacing, whose sides are not well separated, and, if
/// bodies can move, of walls within whose thickness and the two half cells beside them the kernel
/// reaches from the fluid on one side to a body that touches the other. Walls are boxes and meshes;
/// of a mesh only plates count, pieces that are wide in proportion, not columns. Terrain is left
/// out.
void warn_about_thin_walls(const Scene& scene, Plan& plan);

} // namespace hyoryu
