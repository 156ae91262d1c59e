// SPDX-License-Identifier: MIT
// Walls and bodies as surfaces in space: how far a point is from one, and which way leads out.
// Every answer is exact for the shape that the user gave, whatever particles stand in for it.
#pragma once

#include "hyoryu/scene/shapes.hpp"
#include "hyoryu/scene/triangle_tree.hpp"

#include <variant>
#include <vector>

namespace hyoryu {

/// All that is behind a plane through the origin of its axes, in front of which is +z.
struct HalfSpace {};

/// A box about the origin; in two dimensions half.y() is without bound.
struct SolidBox {
    Vec3 half{0, 0, 0}; // of its edges [m]
};

struct SolidBall {
    double radius = 0; // [m]; a disc in two dimensions
};

/// About the x axis, in three dimensions.
struct SolidRod {
    double radius = 0;      // [m]
    double half_length = 0; // [m]
};

/// The sides of a basin: the part of `outer` outside `cavity`, which extends to infinity through
/// the open sides, where `outer` ends at the rim.
struct HollowBox {
    Bounds cavity, outer;      // [m]
    std::vector<Bounds> sides; // whose union it is
};

/// All that is outside of a ball, of a disc in two dimensions.
struct HollowBall {
    double radius = 0; // [m]
};

/// A solid in axes of its own.
struct SolidSurface {
    std::variant<HalfSpace, SolidBox, SolidBall, SolidRod, HollowBox, HollowBall, TriangleTree>
        shape;
    Vec3 centre{0, 0, 0};             // of its axes: where it is at time 0 [m]
    Quat rotation = Quat::Identity(); // of its axes to those of the world at time 0
    double reach = infinity;          // from the centre to its farthest point [m]
    Vec3 middle{0, 0, 0};             // of a body: of its shape, from the centre of mass [m]
};

/// The surface of a wall, or of each of some, at time 0. `thickness`: of the sides of a basin [m].
SolidSurface surface_of(const Wall& wall, double thickness, int dimensions);
std::vector<SolidSurface> surfaces_of(const std::vector<Wall>& walls, double thickness,
                                      int dimensions);

/// The surface of a body; its axes are those of the body.
SolidSurface surface_of(const BodySettings& body, int dimensions);

/// The nearest place of the surface to a point, which is given in the axes of the solid, as is the
/// normal; if the distance exceeds `farthest`, it is infinity and nothing else is set.
NearestPlace nearest_place(const SolidSurface& solid, const Vec3& point,
                           double farthest = infinity);

/// The same for a point at `way` from the centre of the solid [m]; both this and the normal are
/// along the axes of the world at time 0.
NearestPlace nearest_from_centre(const SolidSurface& solid, const Vec3& way,
                                 double farthest = infinity);

} // namespace hyoryu
