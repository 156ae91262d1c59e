// SPDX-License-Identifier: MIT
// Walls as layers of particles behind their surface.
#pragma once

#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/solid_surface.hpp"

namespace hyoryu {

/// Appends the particles of every wall; where two walls overlap, the earlier one keeps its
/// particles.
void fill_walls(const Scene& scene, Filling& filling);

/// The group in `Crowd` of the particles of a wall: those of a mesh are cells of one lattice, which
/// the surface may cut.
std::int32_t crowd_group(const Scene& scene, std::size_t wall);

/// Depth of a point behind the surface of a wall, negative in the free space [m].
double depth_behind(const Wall& wall, const Vec3& point, int dimensions);
/// The same by the tree of a mesh, which looks at few of its triangles.
double depth_behind(const Wall& wall, const SolidSurface& surface, const Vec3& point,
                    int dimensions);

/// Volumes of the cells of the wall particles of a filling [cubes of the spacing].
std::vector<float> wall_cubes(const Scene& scene, const Filling& filling);

/// The least edge of a wall that is a box [m]; infinite for other walls.
double box_thickness(const Wall& wall, int dimensions);

/// Whether a place is within the periods: beyond them there are images of the particles in them.
bool in_period(const Scene& scene, const Vec3& point);

} // namespace hyoryu
