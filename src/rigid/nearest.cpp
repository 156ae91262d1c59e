// SPDX-License-Identifier: MIT
// The nearest point on the surface of a solid, and boundaries as half-spaces or solids.
#include "feature.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Nearer than this to a surface the difference of points gives no direction [m].
constexpr double on_surface = 1e-12;
// A point this part of its body's reach behind a side of a basin is outside, not in contact.
constexpr double basin_slack = 0.05;

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
    const bool inside = std::all_of(face.sides.begin(), face.sides.end(), [&](const Side& side) {
        return side.normal.dot(foot) <= side.offset;
    });
    if (inside) {
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

std::vector<HalfSpace> sides_of(const Basin& basin, int dimensions)
{
    std::vector<HalfSpace> sides;
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        if (basin.open[side] || (dimensions == 2 && axis == 1)) {
            continue;
        }
        HalfSpace half{side};
        half.normal = (side % 2 == 0 ? 1 : -1) * Vec3::Unit(axis);
        half.point = side % 2 == 0 ? basin.min : basin.max;
        half.slack = basin_slack;
        for (int k = 0; k < 3; ++k) { // what is a little beyond the edge of closed sides is held
            if (k == axis || (dimensions == 2 && k == 1)) {
                continue;
            }
            (basin.open[2 * k] ? half.lower : half.from)[k] = basin.min[k];
            (basin.open[2 * k + 1] ? half.upper : half.to)[k] = basin.max[k];
        }
        sides.push_back(half);
    }
    return sides;
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
        HalfSpace half;
        half.normal = plane->normal.normalized();
        half.point = plane->point;
        wall.half_spaces.push_back(half);
    } else if (const auto* basin = std::get_if<Basin>(&boundary.surface)) {
        wall.half_spaces = sides_of(*basin, dimensions);
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
