// SPDX-License-Identifier: MIT
#include "separation.hpp"
#include "tolerances.hpp"

#include <cmath>

namespace hyoryu {

namespace {

// A face axis is kept unless another axis is better by more than this: nearly parallel features
// describe the same contact, and the face gives more contact points [units].
constexpr double face_preference = 1e-7;
// In a deep overlap a face axis is kept unless an edge axis halves the depth: with the single
// contact point of two edges the corners of a face would sink in one after another.
constexpr double overlap_preference = 0.5;

// The pose of b in the frame of a.
struct Relative {
    Mat3 R;
    Vec3 x;
};

double support_distance(const Face& face, const Solid& other, const Mat3& R, const Vec3& x)
{
    // min over corners c of n . (R c + x) - offset
    const Vec3 n = R.transpose() * face.normal;
    double lowest = infinity;
    for (const Vec3& corner : other.corners) {
        lowest = std::min(lowest, n.dot(corner));
    }
    return lowest + face.normal.dot(x) - face.offset;
}

Separation best_face(const PlacedSolid& a, const PlacedSolid& b, const Relative& ab, double enough,
                     double unit)
{
    Separation best;
    for (std::size_t f = 0; f < a.solid.faces.size(); ++f) {
        const double d = support_distance(a.solid.faces[f], b.solid, ab.R, ab.x);
        if (d > best.distance) {
            best = {d, AxisKind::face_of_a, static_cast<int>(f), 0};
            if (d > enough) {
                return best;
            }
        }
    }
    const Mat3 R = ab.R.transpose();
    const Vec3 x = -(R * ab.x);
    double margin = face_preference * unit;
    for (std::size_t f = 0; f < b.solid.faces.size(); ++f) {
        const double d = support_distance(b.solid.faces[f], a.solid, R, x);
        if (d > best.distance + margin) {
            best = {d, AxisKind::face_of_b, 0, static_cast<int>(f)};
            margin = 0;
            if (d > enough) {
                return best;
            }
        }
    }
    return best;
}

// Whether the arcs of two edges cross on the Gauss map, with the normals of b reversed.
bool spans_face(const Solid& a, const Edge& ea, const Vec3& c, const Vec3& d, const Vec3& arc_b)
{
    const double cba = c.dot(ea.arc);
    const double dba = d.dot(ea.arc);
    if (cba * dba >= 0) {
        return false;
    }
    const double adc = a.faces[ea.left].normal.dot(arc_b);
    const double bdc = a.faces[ea.right].normal.dot(arc_b);
    return adc * bdc < 0 && cba * bdc > 0;
}

void improve_by_edges(Separation& best, const PlacedSolid& a, const PlacedSolid& b,
                      const Relative& ab, double unit)
{
    double margin = face_preference * unit + overlap_preference * std::max(0.0, -best.distance);
    for (std::size_t m = 0; m < b.solid.edges.size(); ++m) {
        const Edge& eb = b.solid.edges[m];
        const Vec3 c = -(ab.R * b.solid.faces[eb.left].normal);
        const Vec3 d = -(ab.R * b.solid.faces[eb.right].normal);
        const Vec3 arc_b = ab.R * eb.arc;
        const Vec3 qb = ab.R * b.solid.corners[eb.i] + ab.x;
        const Vec3 db = ab.R * (b.solid.corners[eb.j] - b.solid.corners[eb.i]);
        for (std::size_t k = 0; k < a.solid.edges.size(); ++k) {
            const Edge& ea = a.solid.edges[k];
            if (!spans_face(a.solid, ea, c, d, arc_b)) {
                continue;
            }
            const Vec3& qa = a.solid.corners[ea.i];
            const Vec3 da = a.solid.corners[ea.j] - qa;
            const Vec3 axis = da.cross(db);
            const double length2 = axis.squaredNorm();
            if (length2 < sq(parallel_edges) * da.squaredNorm() * db.squaredNorm()) {
                continue;
            }
            const double sign = axis.dot(qa - a.solid.inside) < 0 ? -1 : 1; // out of a
            const double distance = sign * axis.dot(qb - qa) / std::sqrt(length2);
            if (distance > best.distance + margin) {
                best = {distance, AxisKind::edges, static_cast<int>(k), static_cast<int>(m)};
                margin = 0;
            }
        }
    }
}

// Whether no edge axis can be better than the face axis.
bool covers(const Separation& best, const PlacedSolid& a, const PlacedSolid& b)
{
    return best.kind == AxisKind::face_of_a ? lies_over(b, a, best.a) : lies_over(a, b, best.b);
}

} // namespace

bool lies_over(const PlacedSolid& body, const PlacedSolid& under, int face)
{
    const Vec3 centre = under.pose.R.transpose() *
                        (body.pose.x + body.pose.R * body.solid.box_centre - under.pose.x);
    return past_sides(under.solid.faces[at(face)], centre) <= -body.solid.box_half.norm();
}

Separation separation(const PlacedSolid& a, const PlacedSolid& b, double enough, double unit)
{
    const Relative ab{a.pose.R.transpose() * b.pose.R,
                      a.pose.R.transpose() * (b.pose.x - a.pose.x)};
    Separation best = best_face(a, b, ab, enough, unit);
    if (best.distance <= enough && !covers(best, a, b)) {
        improve_by_edges(best, a, b, ab, unit);
    }
    return best;
}

} // namespace hyoryu
