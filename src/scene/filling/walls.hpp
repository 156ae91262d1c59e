// SPDX-License-Identifier: MIT
// Walls as layers of particles behind their surface.
#pragma once

#include "crowd.hpp"

#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/solid_surface.hpp"

namespace hyoryu {

/// Appends the particles of every wall in places that lie within no other one that moves alike,
/// then those in places within several, of the wall that `OverlapOwner` names.
void fill_walls(const Scene& scene, Filling& filling);

/// Selects the particles of walls that have room, at the seams of walls that overlap. Walls that
/// move in the same way keep 0.6 spacings from each other, those of earlier ones first. Those of a
/// wall that moves in another way do not count: the two will part. Nor do those of the same mesh,
/// cells of a lattice that its surface may cut.
class WallCrowd {
public:
    WallCrowd(const Scene& scene, const std::vector<Vec3>& points);

    /// Whether a point of a wall has room; if it has, it must be appended to the points at once.
    bool add(const Vec3& point, std::size_t wall);

private:
    const Scene& scene_;
    std::vector<std::size_t> first_; // of each wall: the first wall that moves as it does
    std::vector<Crowd> crowds_;      // by first wall
};

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
