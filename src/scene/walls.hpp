// SPDX-License-Identifier: MIT
// Walls as layers of particles behind their surface.
#pragma once

#include "hyoryu/scene/fill.hpp"

namespace hyoryu {

/// Appends the particles of every wall; where two walls overlap, the earlier one keeps its
/// particles.
void fill_walls(const Scene& scene, Filling& filling);

/// Depth of a point behind the surface of a wall, negative in the free space [m].
double depth_behind(const Wall& wall, const Vec3& point, int dimensions);

} // namespace hyoryu
