// SPDX-License-Identifier: MIT
// A contact as a pair of touching features: its identity from step to step, and its location at any
// pose.
#pragma once

#include "rigid/shapes/mesh_table.hpp"
#include "rigid/shapes/rotor.hpp"
#include "rigid/shapes/solid.hpp"

#include "hyoryu/rigid/rigid.hpp"

#include <compare>
#include <optional>
#include <span>
#include <vector>

namespace hyoryu {

/// Position and orientation, with the rotation matrix at hand.
struct SolidPose {
    Vec3 x{0, 0, 0};
    Quat q = Quat::Identity();
    Mat3 R = Mat3::Identity();
};
SolidPose pose_of(const Vec3& x, const Quat& q);

/// A point in the axes of a solid.
inline Vec3 in_frame(const SolidPose& pose, const Vec3& p)
{
    return pose.R.transpose() * (p - pose.x);
}

/// A boundary in the contact search: a plane at time 0, a mesh, or a solid; a basin is the compound
/// of its sides.
struct ContactWall {
    std::optional<Plane> plane;
    MeshTable mesh;
    Solid solid;
    SolidPose pose; // of the solid at time 0
    Motion motion;
};
ContactWall wall_of(const Boundary& boundary, int dimensions);

enum class FeatureKind {
    corner_plane, // corner i of a, the plane or patch f
    ball_plane,   // ball a, the plane or patch f
    rim_low,      // the point of rim i of rod a nearest to the plane or patch f
    round,        // a ball and its nearest point on part f of the partner; on face k - 1 if k > 0
    corner_face,  // corner i of the owner, face f of the other
    crossing,     // edge i-j of the owner over the side k-l of face f of the other
    edge_edge,    // edge i-j of a, edge k-l of b
    rim_face,     // the point of rim i of the owner, a rod, nearest to face f of the other
    cap_cap,      // end j of the chord that cap i of the owner and cap k of the other share
    rod_corner,   // the owner, a rod, and corner k of the other
    side_line,    // the side of the owner, a rod; edge k-l, crease k or the side of the other
    rim_line,     // end j of the chord of rim i of the owner, a rod, along what side_line meets
    rim_rim,      // rim i of rod a, rim j of rod b
    edge_crease,  // edge i-j of a, crease k of a mesh
    face_corner,  // face f of a, corner i of a mesh
    round_crease, // ball a, the nearest point of crease k of a mesh
    round_corner  // ball a, corner i of a mesh
};

/// Bodies a and b (b as in Contact) and their touching features. `owner` 0: i, j belong to a; 1: to
/// b. Corners and faces of a compound are numbered through all parts; the rims of a rod are those
/// of its caps.
struct Feature {
    int a = 0, b = 0;
    FeatureKind kind = FeatureKind::corner_plane;
    int owner = 0;
    int i = 0, j = 0, k = 0, l = 0, f = 0;
    auto operator<=>(const Feature&) const = default;
};

/// Contact point, normal and gap of two features.
struct Touch {
    Vec3 point{0, 0, 0};
    Vec3 normal{0, 0, 1}; // from b to a
    double gap = 0;       // [m], negative if they overlap
};

/// A possible contact: in contact if the gap is within the tolerance.
struct Candidate {
    Feature feature;
    Touch touch;
    bool closing = false; // unlocated steps: open now, closes within the sub-step
};

/// The geometry of all bodies (by index) and boundaries; it does not contain the poses.
struct Geometry {
    std::vector<Solid> solids;
    std::vector<ContactWall> walls;
    double unit = 1; // of tolerances, as of RigidSettings [m]
};

/// A geometry with the poses at one time.
struct Configuration {
    const Geometry& geometry;
    std::span<const SolidPose> poses;
    double time = 0;
};

/// The pose of the axes of a solid, from that of its body about the centre of mass.
SolidPose pose_of_shape(const Solid& solid, const SolidPose& body);

/// A solid and the pose of its axes.
struct PlacedSolid {
    const Solid& solid;
    SolidPose pose;
};
PlacedSolid placed(const Configuration& at, int index);

/// The touch of known features at these poses.
Touch touch_of(const Feature& feature, const Configuration& at);

/// The nearest point of a solid's surface to p, both in its body frame.
Touch nearest(const Solid& solid, const Vec3& p);

} // namespace hyoryu
