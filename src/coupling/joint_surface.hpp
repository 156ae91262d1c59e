// SPDX-License-Identifier: MIT
// Intersection of rays with the surfaces of solids: the surface opposite a face, and the closure of
// a rim.
#pragma once

#include "hyoryu/rigid/box_tree.hpp"
#include "hyoryu/rigid/rigid.hpp"

#include <optional>
#include <vector>

namespace hyoryu {

/// A straight line from a point; the direction is a unit vector.
struct Ray {
    Vec3 origin{0, 0, 0};
    Vec3 direction{0, 0, -1};
};

/// The searched part of a ray, between two distances from its origin [m].
struct RayPart {
    double from = -infinity;
    double to = infinity;
};

/// The stretch [enter, leave] of a ray within a solid, with the outward normal where it enters.
struct RayHit {
    double enter = infinity; // [m]
    double leave = infinity; // [m]
    Vec3 normal{0, 0, 1};
};

/// n . x <= offset.
struct HalfSpaceOf {
    Vec3 normal{0, 0, 1};
    double offset = 0; // [m]
};

/// A convex solid in its own axes: half-spaces, and a ball or a cylinder along the x axis.
struct ConvexPiece {
    enum class Round { none, ball, cylinder };
    std::vector<HalfSpaceOf> sides;
    Round round = Round::none;
    double radius = 0;    // of the round part [m]
    Vec3 middle{0, 0, 0}; // of the round part [m]
};

/// A body or obstacle in its own axes.
struct RaySolid {
    std::vector<ConvexPiece> pieces;
    double reach = 0;          // largest distance of a point from the origin [m]
    std::vector<Vec3> corners; // of polytopes; on the rims of a rod; none of a ball
};
RaySolid ray_solid(const ContactShape& shape, int dimensions);

/// The largest distance of a corner from the line through the origin along a unit vector in the
/// axes of the solid [m]; of a ball its reach.
double reach_across(const RaySolid& solid, const Vec3& along);

/// The plane of a face with its outward normal, as seen from a point inside; none of a face without
/// an area.
std::optional<HalfSpaceOf> side_through(const Polytope& shape, const std::vector<int>& face,
                                        const Vec3& inside);

/// Whether a point lies within a piece, or less than `margin` off.
bool holds(const ConvexPiece& piece, const Vec3& point, double margin);

/// Signed distance of a point from the surface [m], negative inside; exact inside convex solids,
/// beside their edges too small.
double distance(const RaySolid& solid, const Vec3& point);

/// Whether a part of a ray comes as near to a point as `reach`: if not, it meets nothing of a solid
/// that reaches no farther from there.
bool comes_near(const Ray& ray, const RayPart& part, const Vec3& point, double reach);

/// Where a ray in the axes of the solid first enters it, if it does.
std::optional<RayHit> enters(const RaySolid& solid, const Ray& ray);

/// A boundary at time 0 in world axes.
struct RayWall {
    std::vector<HalfSpaceOf> half_spaces; // solid where n . x <= offset
    Vec3 low = Vec3::Constant(-infinity); // between these the half-spaces hold [m]
    Vec3 high = Vec3::Constant(infinity);
    RaySolid solid;
    Vec3 position{0, 0, 0}; // of the solid
    Quat orientation = Quat::Identity();
    std::vector<std::array<Vec3, 3>> triangles;
    BoxTree tree; // of the triangles
};
RayWall ray_wall(const Boundary& boundary, int dimensions);

/// Whether anything of the wall lies within `reach` of a point.
bool near_wall(const RayWall& wall, const Vec3& point, double reach);

/// Where the ray first enters the wall. Solids and triangles are tested only in the given part of
/// the ray: triangles define no interval of the ray inside the wall, and most are far from it.
std::optional<RayHit> enters(const RayWall& wall, const Ray& ray, const RayPart& part);

} // namespace hyoryu
