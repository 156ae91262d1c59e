// SPDX-License-Identifier: MIT
// Particles of a mesh in layers that follow its surface.
#pragma once

#include "hyoryu/scene/scene.hpp"

namespace hyoryu {

/// Moves the particles of a mesh that lie within three spacings of its surface, given on a lattice,
/// to layers at half a spacing, one and a half and two and a half below it, and evens them out
/// along it; where layers of two sides meet at an edge, some are dropped. A staircase of lattice
/// points would have 25 % too much added mass.
void conform_to_surface(const MeshShape& mesh, double spacing, std::vector<Vec3>& points);

/// The place on a triangle of a mesh that is nearest to a point.
Vec3 closest_on_triangle(const MeshShape& mesh, const std::array<int, 3>& triangle,
                         const Vec3& point);

} // namespace hyoryu
