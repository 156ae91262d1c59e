// SPDX-License-Identifier: MIT
// Shapes as sets of points: volume, bounds, signed distance. In two dimensions a shape is its
// section with the x-z plane, a volume is an area and y is ignored.
#pragma once

#include "hyoryu/scene/scene.hpp"

namespace hyoryu {

/// Axis-aligned bounds.
struct Bounds {
    Vec3 min{infinity, infinity, infinity};
    Vec3 max{-infinity, -infinity, -infinity};
    bool empty() const { return !(min.x() <= max.x()); }
    void add(const Vec3& point)
    {
        min = min.cwiseMin(point);
        max = max.cwiseMax(point);
    }
    void add(const Bounds& other)
    {
        min = min.cwiseMin(other.min);
        max = max.cwiseMax(other.max);
    }
};

/// A shape placed in space.
struct Placed {
    const Shape* shape = nullptr;
    Vec3 centre{0, 0, 0}; // [m]
    Quat rotation = Quat::Identity();
    int dimensions = 3;
};

/// The middle of the shape of a body from its centre of mass, in body axes [m].
Vec3 middle_of_shape(const BodySettings& body);

/// Moves points about the middle of its shape to axes about its centre of mass.
void move_to_middle(const BodySettings& body, std::vector<Vec3>& points);

/// The shape of a body, a block or an obstacle where it is at the start; it points to that shape.
Placed placed(const BodySettings& body, int dimensions);
Placed placed(const FluidBlock& block, int dimensions);
Placed placed(const SolidWall& solid, int dimensions);

/// Volume [m3], or area [m2] in two dimensions.
double volume(const Shape& shape, int dimensions);

/// Distance to the surface [m], negative inside. Exact outside the edges of a box or cylinder only
/// up to the usual Euclidean corner distance, as the callers need.
double signed_distance(const Placed& placed, const Vec3& point);

/// Bounds in space.
Bounds bounds(const Placed& placed);

/// Bounds of a wall at time 0: of the inside of a basin, of an obstacle; empty for a plane.
Bounds bounds(const Wall& wall, int dimensions);

/// The region of the run: as given by the user, or the bounds of everything in the scene with
/// headroom of its height above it for splashes.
Bounds domain_of(const Scene& scene);

/// Whether a point is in the box of a sponge; in two dimensions y does not count.
inline bool holds(const Sponge& sponge, const Vec3& x, int dimensions)
{
    const bool across = dimensions == 2 || (x.y() >= sponge.min.y() && x.y() <= sponge.max.y());
    return across && x.x() >= sponge.min.x() && x.x() <= sponge.max.x() &&
           x.z() >= sponge.min.z() && x.z() <= sponge.max.z();
}

} // namespace hyoryu
