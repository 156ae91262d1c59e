// SPDX-License-Identifier: MIT
// Gap functions: where a pair of features touches, at any pose.
#include "feature.hpp"
#include "mesh_contact.hpp"
#include "rigid/shapes/compound.hpp"
#include "rod_touch.hpp"
#include "tolerances.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// The centre of a shape, from the pose of its body.
Vec3 middle_of(const Solid& solid, const SolidPose& body)
{
    return solid.middle.isZero(0) ? body.x : Vec3(body.x + body.R * solid.middle);
}

// A solid in world axes, without a copy of the rotation matrix.
struct Frame {
    const Solid& solid;
    Vec3 x;
    const Mat3& R;
};

Frame frame_of(const Configuration& at, int index)
{
    if (index >= 0) {
        const Solid& solid = at.geometry.solids[index];
        const SolidPose& pose = at.poses[index];
        return {solid, middle_of(solid, pose), pose.R};
    }
    const ContactWall& wall = at.geometry.walls[-1 - index];
    return {wall.solid, wall.pose.x + displacement(wall.motion, at.time), wall.pose.R};
}

// The plane of a boundary or of a patch of its mesh, at time 0.
Plane plane_of(const ContactWall& wall, int side)
{
    if (!wall.mesh.patches.empty()) {
        const Patch& patch = wall.mesh.patches[side];
        return {patch.offset * patch.normal, patch.normal};
    }
    return *wall.plane;
}

Touch plane_touch(const Feature& feature, const Configuration& at)
{
    const ContactWall& wall = at.geometry.walls[-1 - feature.b];
    const Plane plane = plane_of(wall, feature.f);
    const auto [solid, pose] = placed(at, feature.a);
    Touch touch;
    touch.normal = plane.normal;
    if (feature.kind == FeatureKind::corner_plane) {
        touch.point = pose.x + pose.R * solid.corners[feature.i];
    } else if (feature.kind == FeatureKind::ball_plane) {
        touch.point = pose.x - solid.radius * plane.normal;
    } else {
        touch.point = low_point({solid, pose}, feature.i, plane.normal);
    }
    touch.gap = plane.normal.dot(touch.point - plane.point - displacement(wall.motion, at.time));
    return touch;
}

// The touch on the plane of a face, which is extended beyond its rim.
Touch over_face(const Face& face, const Vec3& p)
{
    const double gap = face.normal.dot(p) - face.offset;
    return {p - gap * face.normal, face.normal, gap};
}

Touch round_touch(const Feature& feature, const Configuration& at)
{
    const bool ball_is_a = feature.owner == 0;
    const PlacedSolid ball = placed(at, ball_is_a ? feature.a : feature.b);
    const PlacedSolid other = placed(at, ball_is_a ? feature.b : feature.a);
    const Mat3& R = other.pose.R;
    const Solid& part = convex_parts(other.solid)[feature.f];
    const Vec3 centre = R.transpose() * (ball.pose.x - other.pose.x);
    const Touch local =
        feature.k > 0 ? over_face(part.faces[feature.k - 1], centre) : nearest(part, centre);
    const Vec3 out = R * local.normal;
    return {other.pose.x + R * local.point, ball_is_a ? out : Vec3(-out),
            local.gap - ball.solid.radius};
}

Touch face_touch(const Feature& feature, const Configuration& at)
{
    const bool owner_is_a = feature.owner == 0;
    const Frame owner = frame_of(at, owner_is_a ? feature.a : feature.b);
    const Frame other = frame_of(at, owner_is_a ? feature.b : feature.a);
    const Face& face = other.solid.faces[feature.f];
    Vec3 c = owner.solid.corners[feature.i];
    if (feature.kind == FeatureKind::crossing) {
        // where the edge passes the side k-l of the face, both seen along the normal of the face
        const Vec3 n = other.R * face.normal;
        const Vec3 k = other.x + other.R * other.solid.corners[feature.k];
        const Vec3 l = other.x + other.R * other.solid.corners[feature.l];
        const Vec3 side = (l - k).cross(n);
        const Vec3 d = owner.solid.corners[feature.j] - c;
        const double along = side.dot(owner.R * d);
        const double from = side.dot(k - owner.x - owner.R * c);
        const double t = std::abs(along) > 0 ? std::clamp(from / along, 0.0, 1.0) : 0.5;
        c += t * d;
    }
    const Vec3 point = owner.x + owner.R * c;
    const Vec3 n = other.R * face.normal;
    const double gap = n.dot(point - other.x) - face.offset;
    return {point, owner_is_a ? n : Vec3(-n), gap};
}

// The middle of the part that has a corner.
Vec3 middle_at(const Frame& body, int corner)
{
    return body.x + body.R * part_of_corner(body.solid, corner).inside;
}

// Nearest points of two lines, kept on the edges.
Touch edge_touch(const Feature& feature, const Configuration& at)
{
    const Frame a = frame_of(at, feature.a);
    const Frame b = frame_of(at, feature.b);
    const Vec3 p = a.x + a.R * a.solid.corners[feature.i];
    const Vec3 q = b.x + b.R * b.solid.corners[feature.k];
    const Vec3 u = a.R * (a.solid.corners[feature.j] - a.solid.corners[feature.i]);
    const Vec3 w = b.R * (b.solid.corners[feature.l] - b.solid.corners[feature.k]);
    const Vec3 cross = u.cross(w);
    const double length = cross.norm();
    if (length <= no_direction * u.norm() * w.norm()) {
        const Vec3 away = (middle_at(a, feature.i) - middle_at(b, feature.k)).normalized();
        return {p, away, away.dot(p - q)};
    }
    Vec3 n = cross / length;
    if (n.dot(middle_at(a, feature.i) - middle_at(b, feature.k)) < 0) {
        n = -n;
    }
    const Vec3 r = q - p;
    const double s = std::clamp(r.cross(w).dot(cross) / sq(length), 0.0, 1.0);
    const double t = std::clamp(r.cross(u).dot(cross) / sq(length), 0.0, 1.0);
    const Vec3 on_a = p + s * u;
    const Vec3 on_b = q + t * w;
    return {0.5 * (on_a + on_b), n, n.dot(on_a - on_b)};
}

} // namespace

SolidPose pose_of(const Vec3& x, const Quat& q)
{
    return {x, q, q.toRotationMatrix()};
}

SolidPose pose_of_shape(const Solid& solid, const SolidPose& body)
{
    SolidPose pose = body;
    pose.x = middle_of(solid, body);
    return pose;
}

PlacedSolid placed(const Configuration& at, int index)
{
    const Frame frame = frame_of(at, index);
    SolidPose pose = index >= 0 ? at.poses[index] : at.geometry.walls[-1 - index].pose;
    pose.x = frame.x;
    return {frame.solid, pose};
}

Touch touch_of(const Feature& feature, const Configuration& at)
{
    switch (feature.kind) {
    case FeatureKind::corner_plane:
    case FeatureKind::ball_plane:
    case FeatureKind::rim_low:
        return plane_touch(feature, at);
    case FeatureKind::round:
        return round_touch(feature, at);
    case FeatureKind::corner_face:
    case FeatureKind::crossing:
        return face_touch(feature, at);
    case FeatureKind::edge_edge:
        return edge_touch(feature, at);
    case FeatureKind::rim_face:
    case FeatureKind::cap_cap:
    case FeatureKind::rod_corner:
    case FeatureKind::side_line:
    case FeatureKind::rim_line:
    case FeatureKind::rim_rim:
        return rod_touch(feature, at).touch;
    case FeatureKind::edge_crease:
    case FeatureKind::face_corner:
    case FeatureKind::round_crease:
    case FeatureKind::round_corner:
        return mesh_touch(feature, at);
    }
    return {};
}

} // namespace hyoryu
