// SPDX-License-Identifier: MIT
// The nearest point on the surface of a solid, and boundaries as planes, meshes or solids.
#include "feature.hpp"
#include "rigid/shapes/compound.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Distance from a surface below which the difference of two points defines no direction [m].
constexpr double on_surface = 1e-12;

Touch nearest_on_ball(const Solid& ball, const Vec3& p)
{
    const double r = p.norm();
    const Vec3 n = r > on_surface ? Vec3(p / r) : Vec3(0, 0, 1);
    return {ball.radius * n, n, r - ball.radius};
}

Touch nearest_on_rod(const Solid& rod, const Vec3& p)
{
    const Vec3 across(0, p.y(), p.z());
    const double r = across.norm();
    const Vec3 out = r > on_surface ? Vec3(across / r) : Vec3(0, 0, 1);
    const Vec3 end(p.x() < 0 ? -1 : 1, 0, 0);
    const double beyond_side = r - rod.radius;
    const double beyond_end = std::abs(p.x()) - rod.half_length;
    if (beyond_side > 0 && beyond_end > 0) {
        const Vec3 rim = rod.half_length * end + rod.radius * out;
        const double d = (p - rim).norm();
        return {rim, (p - rim) / d, d};
    }
    if (beyond_side > beyond_end) {
        return {p - beyond_side * out, out, beyond_side};
    }
    return {p - beyond_end * end, end, beyond_end};
}

Vec3 nearest_on_segment(const Vec3& a, const Vec3& b, const Vec3& p)
{
    const Vec3 d = b - a;
    const double length2 = d.squaredNorm();
    const double t = length2 > 0 ? std::clamp(d.dot(p - a) / length2, 0.0, 1.0) : 0;
    return a + t * d;
}

// The nearest point of one face to a point in front of it.
Vec3 nearest_on_face(const Solid& solid, const Face& face, const Vec3& p)
{
    const Vec3 foot = p - (face.normal.dot(p) - face.offset) * face.normal;
    if (past_sides(face, foot) <= 0) {
        return foot;
    }
    Vec3 best = foot;
    double best2 = infinity;
    for (const Side& side : face.sides) {
        const Vec3 q = nearest_on_segment(solid.corners[side.i], solid.corners[side.j], p);
        if ((p - q).squaredNorm() < best2) {
            best2 = (p - q).squaredNorm();
            best = q;
        }
    }
    return best;
}

Touch nearest_on_polytope(const Solid& solid, const Vec3& p)
{
    double deepest = -infinity;
    const Face* deepest_face = nullptr;
    Touch best{p, Vec3(0, 0, 1), infinity};
    for (const Face& face : solid.faces) {
        const double d = face.normal.dot(p) - face.offset;
        if (d > deepest) {
            deepest = d;
            deepest_face = &face;
        }
        if (d > on_surface && d < best.gap) {
            const Vec3 q = nearest_on_face(solid, face, p);
            const double distance = (p - q).norm();
            if (distance < best.gap) {
                best = {q, (p - q) / distance, distance};
            }
        }
    }
    if (best.gap < infinity) {
        return best;
    }
    return {p - deepest * deepest_face->normal, deepest_face->normal, deepest};
}

// A box from `low` to `high`, in the axes whose origin is `origin`.
Polytope box_between(const Vec3& low, const Vec3& high, const Vec3& origin, int dimensions)
{
    Polytope box = box_polytope(high - low, dimensions);
    for (Vec3& corner : box.corners) { // exact planes: no sums of halves
        for (int k = 0; k < 3; ++k) {
            if (dimensions == 3 || k != 1) {
                corner[k] = (corner[k] < 0 ? low[k] : high[k]) - origin[k];
            }
        }
    }
    return box;
}

// The closed sides as slabs that overlap at common edges and corners; the origin is the lower
// corner.
Compound slabs_of(const Basin& basin, int dimensions)
{
    Compound slabs;
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        if (basin.open[side] || (dimensions == 2 && axis == 1)) {
            continue;
        }
        Vec3 low = basin.min;
        Vec3 high = basin.max;
        for (int k = 0; k < 3; ++k) {
            low[k] -= basin.open[2 * k] ? 0 : basin.thickness;
            high[k] += basin.open[2 * k + 1] ? 0 : basin.thickness;
        }
        (side % 2 == 0 ? high : low)[axis] = (side % 2 == 0 ? basin.min : basin.max)[axis];
        slabs.parts.push_back(box_between(low, high, basin.min, dimensions));
    }
    return slabs;
}

} // namespace

Touch nearest(const Solid& solid, const Vec3& p)
{
    switch (solid.form) {
    case Form::ball:
        return nearest_on_ball(solid, p);
    case Form::rod:
        return nearest_on_rod(solid, p);
    case Form::polytope:
        return nearest_on_polytope(solid, p);
    case Form::compound: {
        Touch best{p, Vec3::UnitZ(), infinity};
        for (const Solid& part : solid.parts) {
            const Touch touch = nearest_on_polytope(part, p);
            best = touch.gap < best.gap ? touch : best;
        }
        return best;
    }
    }
    return {};
}

ContactWall wall_of(const Boundary& boundary, int dimensions)
{
    ContactWall wall;
    wall.motion = boundary.motion;
    if (const auto* plane = std::get_if<Plane>(&boundary.surface)) {
        wall.plane = Plane{plane->point, plane->normal.normalized()};
    } else if (const auto* basin = std::get_if<Basin>(&boundary.surface)) {
        wall.solid = compound_solid(slabs_of(*basin, dimensions), dimensions);
        wall.pose = pose_of(dimensions == 3 ? basin->min : Vec3(basin->min.x(), 0, basin->min.z()),
                            Quat::Identity());
    } else if (const auto* mesh = std::get_if<MeshSurface>(&boundary.surface)) {
        wall.mesh = mesh_table(*mesh);
    } else {
        const auto& obstacle = std::get<Obstacle>(boundary.surface);
        wall.solid = solid_of(obstacle.shape, dimensions);
        wall.pose = pose_of(obstacle.position, obstacle.orientation);
    }
    return wall;
}

} // namespace hyoryu
