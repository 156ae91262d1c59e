// SPDX-License-Identifier: MIT
#include "mesh_separation.hpp"
#include "tolerances.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

TriangleAxis above(const PartAt& part, const Patch& patch)
{
    TriangleAxis axis;
    axis.distance = infinity;
    for (std::size_t k = 0; k < part.corners.size(); ++k) {
        const double d = patch.normal.dot(part.corners[k]) - patch.offset;
        if (d < axis.distance) {
            axis.distance = d;
            axis.corner = static_cast<int>(k);
        }
    }
    return axis;
}

TriangleAxis under_face(const PartAt& part, std::size_t f, const FlatTriangle& triangle)
{
    TriangleAxis axis{infinity, TriangleAxis::Kind::face, static_cast<int>(f), 0};
    for (int k = 0; k < 3; ++k) {
        const double d = part.normals[f].dot(triangle.point[at(k)]) - part.offsets[f];
        if (d < axis.distance) {
            axis.distance = d;
            axis.corner = k;
        }
    }
    return axis;
}

// Keeps the better of two axes; an axis that points behind the triangle counts only while it
// separates or touches.
void improve(TriangleAxis& best, const TriangleAxis& axis, const Vec3& n, const Patch& patch,
             double touch)
{
    const bool backward = n.dot(patch.normal) < 0;
    if (axis.distance > best.distance && !(backward && axis.distance < -touch)) {
        const int deepest = best.corner;
        best = axis;
        if (axis.kind == TriangleAxis::Kind::edges) {
            best.corner = deepest;
        }
    }
}

void improve_by_edges(TriangleAxis& best, const PartAt& part, const FlatTriangle& triangle,
                      const Patch& patch, int deepest, double enough, double touch)
{
    for (const Edge& edge : part.solid.edges) {
        const Vec3& c = part.corners[at(edge.i)];
        const Vec3 u = part.corners[at(edge.j)] - c;
        for (std::size_t k = 0; k < 3 && best.distance <= enough; ++k) {
            const Vec3 w = triangle.point[(k + 1) % 3] - triangle.point[k];
            const Vec3 cross = u.cross(w);
            const double length = cross.norm();
            if (length <= parallel_edges * u.norm() * w.norm()) {
                continue;
            }
            for (const double sign : {1.0, -1.0}) {
                const Vec3 n = sign / length * cross;
                if (!rests_on(part, edge, n, 0)) {
                    continue;
                }
                double highest = -infinity;
                for (const Vec3& v : triangle.point) {
                    highest = std::max(highest, n.dot(v));
                }
                improve(best, {n.dot(c) - highest, TriangleAxis::Kind::edges, 0, deepest}, n, patch,
                        touch);
            }
        }
    }
}

} // namespace

PartAt part_at(const Solid& whole, const Solid& part, const SolidPose& pose, const Vec3& shift)
{
    PartAt at{whole, part, pose, {}, {}, {}, {}, {}};
    at.pose.x -= shift;
    at.middle = at.pose.x + pose.R * part.inside;
    for (const Vec3& corner : part.corners) {
        at.corners.emplace_back(at.pose.x + pose.R * corner);
        at.box.add(at.corners.back());
    }
    for (const Face& face : part.faces) {
        at.normals.emplace_back(pose.R * face.normal);
        at.offsets.push_back(face.offset + at.normals.back().dot(at.pose.x));
    }
    return at;
}

TriangleAxis triangle_axis(const PartAt& part, const MeshTable& mesh, const FlatTriangle& triangle,
                           double enough, double touch)
{
    const Patch& patch = mesh.patches[at(triangle.patch)];
    TriangleAxis best;
    if (patch.normal.dot(part.middle) <= patch.offset) {
        best.distance = infinity;
        return best;
    }
    best = above(part, patch);
    const int deepest = best.corner;
    for (std::size_t f = 0; f < part.normals.size() && best.distance <= enough; ++f) {
        improve(best, under_face(part, f, triangle), -part.normals[f], patch, touch);
    }
    if (best.distance <= enough) {
        improve_by_edges(best, part, triangle, patch, deepest, enough, touch);
    }
    return best;
}

bool rests_on(const PartAt& part, const Edge& edge, const Vec3& n, double slack)
{
    const Vec3 d = (part.corners[at(edge.j)] - part.corners[at(edge.i)]).normalized();
    const Vec3 into_left = part.normals[at(edge.left)].cross(d);
    const Vec3 into_right = d.cross(part.normals[at(edge.right)]);
    return n.dot(into_left) >= -slack && n.dot(into_right) >= -slack;
}

} // namespace hyoryu
