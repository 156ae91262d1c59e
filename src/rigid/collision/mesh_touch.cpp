// SPDX-License-Identifier: MIT
// Gap functions of the features that only meshes have.
#include "mesh_contact.hpp"
#include "tolerances.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// A crease where it is now.
struct Line {
    Vec3 from{0, 0, 0};
    Vec3 along{0, 0, 0};
};

Touch edge_on_crease(const Feature& feature, const PlacedSolid& a, const Line& line,
                     const Crease& crease)
{
    const Vec3 p = a.pose.x + a.pose.R * a.solid.corners[hyoryu::at(feature.i)];
    const Vec3 u = a.pose.R * (a.solid.corners[hyoryu::at(feature.j)] -
                               a.solid.corners[hyoryu::at(feature.i)]);
    const Vec3& w = line.along;
    const Vec3 r = line.from - p;
    const Vec3 cross = u.cross(w);
    const double length = cross.norm();
    if (length <= no_direction * u.norm() * w.norm()) {
        const Vec3 n = crease.outward.normalized();
        return {p, n, -n.dot(r)};
    }
    const Vec3 n = (cross.dot(crease.outward) < 0 ? -1 : 1) / length * cross;
    const double s = std::clamp(r.cross(w).dot(cross) / sq(length), 0.0, 1.0);
    const double t = std::clamp(r.cross(u).dot(cross) / sq(length), 0.0, 1.0);
    const Vec3 on_a = p + s * u;
    const Vec3 on_b = line.from + t * w;
    return {0.5 * (on_a + on_b), n, n.dot(on_a - on_b)};
}

Touch ball_on_point(const PlacedSolid& ball, const Vec3& point)
{
    const Vec3 out = ball.pose.x - point;
    const double distance = out.norm();
    return {point, distance > 0 ? Vec3(out / distance) : Vec3(Vec3::UnitZ()),
            distance - ball.solid.radius};
}

} // namespace

Touch mesh_touch(const Feature& feature, const Configuration& at)
{
    const ContactWall& wall = at.geometry.walls[hyoryu::at(-1 - feature.b)];
    const PlacedSolid a = placed(at, feature.a);
    const Vec3 shift = displacement(wall.motion, at.time);
    if (feature.kind == FeatureKind::face_corner) {
        const Face& face = a.solid.faces[hyoryu::at(feature.f)];
        const Vec3 n = a.pose.R * face.normal;
        const Vec3 point = wall.mesh.corners[hyoryu::at(feature.i)].point + shift;
        return {point, -n, n.dot(point - a.pose.x) - face.offset};
    }
    if (feature.kind == FeatureKind::round_corner) {
        return ball_on_point(a, wall.mesh.corners[hyoryu::at(feature.i)].point + shift);
    }
    const Crease& crease = wall.mesh.creases[hyoryu::at(feature.k)];
    const Vec3& end = wall.mesh.corners[hyoryu::at(crease.i)].point;
    const Line line{end + shift, wall.mesh.corners[hyoryu::at(crease.j)].point - end};
    if (feature.kind == FeatureKind::edge_crease) {
        return edge_on_crease(feature, a, line, crease);
    }
    const double t =
        std::clamp(line.along.dot(a.pose.x - line.from) / line.along.squaredNorm(), 0.0, 1.0);
    return ball_on_point(a, line.from + t * line.along);
}

} // namespace hyoryu
