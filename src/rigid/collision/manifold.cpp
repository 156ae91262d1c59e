// SPDX-License-Identifier: MIT
#include "manifold.hpp"
#include "tolerances.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// If the faces are parallel to within acos of this, corners of the reference face are contacts,
// too.
constexpr double face_to_face = 0.9;
// An edge-edge axis within this sine of a face normal is replaced by the face. Resting faces tilt
// by the round-off of their gaps and so touch at one crossing of their rims, a different one in
// every step; the other corners, a micrometre away, share the load.
constexpr double nearly_flush = 1e-3;

// The solid r of the reference face, the incident solid i, and the outward normal of the reference
// face in world axes.
struct FaceMeeting {
    const BodyPair& pair;
    const Configuration& at;
    PlacedSolid r;
    PlacedSolid i;
    int reference = 0;
    int incident = 0;
    int owner = 0; // 0 if the incident solid is a
    int deepest = 0;
    Vec3 normal{0, 0, 1};
    double tolerance = 0;
};

Vec3 seen_from(const PlacedSolid& frame, const PlacedSolid& other, const Vec3& point)
{
    return frame.pose.R.transpose() * (other.pose.x + other.pose.R * point - frame.pose.x);
}

int deepest_corner(const Solid& solid, const Vec3& n)
{
    int deepest = 0;
    for (int k = 1; k < static_cast<int>(solid.corners.size()); ++k) {
        if (n.dot(solid.corners[k]) < n.dot(solid.corners[deepest])) {
            deepest = k;
        }
    }
    return deepest;
}

// Among the faces of the deepest corner, the one that looks most against the normal.
int facing_face(const Solid& solid, int corner, const Vec3& n)
{
    int best = -1;
    for (const int f : solid.faces_of_corner[corner]) {
        if (best < 0 || n.dot(solid.faces[f].normal) < n.dot(solid.faces[best].normal)) {
            best = f;
        }
    }
    return best;
}

void add_once(const FaceMeeting& m, const Feature& feature, std::size_t first,
              std::vector<Candidate>& found)
{
    const Touch touch = touch_of(feature, m.at);
    const bool known = std::any_of(
        found.begin() + static_cast<std::ptrdiff_t>(first), found.end(), [&](const Candidate& c) {
            const Vec3 d = c.touch.point - touch.point;
            return (d - m.normal * m.normal.dot(d)).norm() < 2 * m.tolerance;
        });
    if (!known) {
        found.push_back({feature, touch});
    }
}

Feature corner_feature(const FaceMeeting& m, int owner, int corner, int face)
{
    Feature feature{m.pair.a, m.pair.b, FeatureKind::corner_face, owner};
    const bool of_incident = owner == m.owner;
    feature.i = corner + (of_incident ? m.i : m.r).solid.first_corner;
    feature.f = face + (of_incident ? m.r : m.i).solid.first_face;
    return feature;
}

void add_corners(const FaceMeeting& m, std::size_t first, std::vector<Candidate>& found)
{
    const Face& reference = m.r.solid.faces[m.reference];
    const Face& incident = m.i.solid.faces[m.incident];
    for (const int k : incident.corners) {
        if (past_sides(reference, seen_from(m.r, m.i, m.i.solid.corners[k])) <= m.tolerance) {
            add_once(m, corner_feature(m, m.owner, k, m.reference), first, found);
        }
    }
    if ((m.i.pose.R * incident.normal).dot(m.normal) > -face_to_face) {
        return;
    }
    for (const int k : reference.corners) {
        if (past_sides(incident, seen_from(m.i, m.r, m.r.solid.corners[k])) <= m.tolerance) {
            add_once(m, corner_feature(m, 1 - m.owner, k, m.incident), first, found);
        }
    }
}

// Crossings of edges of the incident face with sides of the reference face, away from all corners.
void add_crossings(const FaceMeeting& m, std::size_t first, std::vector<Candidate>& found)
{
    const Face& reference = m.r.solid.faces[m.reference];
    for (const Side& edge : m.i.solid.faces[m.incident].sides) {
        const Vec3 p = seen_from(m.r, m.i, m.i.solid.corners[edge.i]);
        const Vec3 q = seen_from(m.r, m.i, m.i.solid.corners[edge.j]);
        for (const Side& side : reference.sides) {
            const double dp = side.normal.dot(p) - side.offset;
            const double dq = side.normal.dot(q) - side.offset;
            if (dp * dq >= 0 || std::min(std::abs(dp), std::abs(dq)) <= m.tolerance) {
                continue;
            }
            const Vec3 c = p + dp / (dp - dq) * (q - p);
            if (past_sides(reference, c) <= m.tolerance) {
                Feature feature{m.pair.a, m.pair.b, FeatureKind::crossing, m.owner};
                feature.i = m.i.solid.first_corner + std::min(edge.i, edge.j);
                feature.j = m.i.solid.first_corner + std::max(edge.i, edge.j);
                feature.k = m.r.solid.first_corner + side.i;
                feature.l = m.r.solid.first_corner + side.j;
                feature.f = m.r.solid.first_face + m.reference;
                add_once(m, feature, first, found);
            }
        }
    }
}

void add_faces(const FaceMeeting& m, double distance, std::vector<Candidate>& found)
{
    const std::size_t first = found.size();
    add_corners(m, first, found);
    add_crossings(m, first, found);
    double lowest = infinity;
    for (std::size_t k = first; k < found.size(); ++k) {
        lowest = std::min(lowest, found[k].touch.gap);
    }
    // If a corner lies just past the rim, no candidate has a gap as small as the distance along the
    // axis; the deepest corner is then added.
    if (lowest > distance + m.tolerance) {
        const Feature corner = corner_feature(m, m.owner, m.deepest, m.reference);
        found.push_back({corner, touch_of(corner, m.at)});
    }
}

// The unit axis of two edges in world axes, out of a.
Vec3 axis_of_edges(const PartPair& parts, const Edge& ea, const Edge& eb)
{
    const auto along = [](const PlacedSolid& p, const Edge& e) {
        return Vec3(p.pose.R * (p.solid.corners[e.j] - p.solid.corners[e.i]));
    };
    const Vec3 axis = along(parts.a, ea).cross(along(parts.b, eb)).normalized();
    const Vec3 outward = parts.a.pose.R * (parts.a.solid.corners[ea.i] - parts.a.solid.inside);
    return axis.dot(outward) < 0 ? Vec3(-axis) : axis;
}

// Replaces an edge-edge axis by the axis of a face with nearly the same normal, if there is one.
Separation flush(const PartPair& parts, const Separation& axis)
{
    const Edge& ea = parts.a.solid.edges[axis.a];
    const Edge& eb = parts.b.solid.edges[axis.b];
    const Vec3 n = axis_of_edges(parts, ea, eb);
    const auto all_but = [](const PlacedSolid& p, int face, const Vec3& out) {
        const Vec3 normal = p.pose.R * p.solid.faces[face].normal;
        return normal.dot(out) > 0 && normal.cross(out).norm() < nearly_flush;
    };
    for (const int face : {ea.left, ea.right}) {
        if (all_but(parts.a, face, n)) {
            return {axis.distance, AxisKind::face_of_a, face, 0};
        }
    }
    for (const int face : {eb.left, eb.right}) {
        if (all_but(parts.b, face, -n)) {
            return {axis.distance, AxisKind::face_of_b, 0, face};
        }
    }
    return axis;
}

FaceMeeting meeting(const BodyPair& pair, const PartPair& parts, const Separation& axis,
                    const Configuration& at)
{
    const bool a_refers = axis.kind == AxisKind::face_of_a;
    FaceMeeting m{pair, at, a_refers ? parts.a : parts.b, a_refers ? parts.b : parts.a};
    m.reference = a_refers ? axis.a : axis.b;
    m.owner = a_refers ? 1 : 0;
    m.normal = m.r.pose.R * m.r.solid.faces[m.reference].normal;
    const Vec3 n = m.i.pose.R.transpose() * m.normal;
    m.deepest = deepest_corner(m.i.solid, n);
    m.incident = facing_face(m.i.solid, m.deepest, n);
    m.tolerance = rim_tolerance * std::min(m.r.solid.reach, m.i.solid.reach);
    return m;
}

} // namespace

void add_manifold(const BodyPair& pair, const PartPair& parts, const Separation& axis,
                  const Configuration& at, std::vector<Candidate>& found)
{
    const Separation meets = axis.kind == AxisKind::edges ? flush(parts, axis) : axis;
    if (meets.kind != AxisKind::edges) {
        add_faces(meeting(pair, parts, meets, at), meets.distance, found);
        return;
    }
    const Edge& ea = parts.a.solid.edges[axis.a];
    const Edge& eb = parts.b.solid.edges[axis.b];
    const int a = parts.a.solid.first_corner;
    const int b = parts.b.solid.first_corner;
    const Feature feature{pair.a,   pair.b, FeatureKind::edge_edge, 0, a + ea.i, a + ea.j, b + eb.i,
                          b + eb.j, 0};
    found.push_back({feature, touch_of(feature, at)});
}

} // namespace hyoryu
