// SPDX-License-Identifier: MIT
#include "mesh_contact.hpp"
#include "covered.hpp"
#include "mesh_ball_rod.hpp"
#include "mesh_separation.hpp"
#include "rigid/shapes/compound.hpp"
#include "tolerances.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// Largest gap of a contact between features of polytopes [units].
constexpr double near_enough = 1e-5;
// Part of an edge at each end that belongs to the corner.
constexpr double edge_end = 1e-6;

// Features represent an overlap if their depth is at least this part of that along the axis.
constexpr double shown = 0.5;

// Collects the features of one convex part of a body and a mesh.
class PartSearch {
public:
    PartSearch(const BodyPair& pair, const Configuration& at, const PartAt& part,
               std::vector<Candidate>& found)
        : pair_(pair), at_(at), mesh_(at.geometry.walls[hyoryu::at(-1 - pair.b)].mesh), part_(part),
          found_(found), first_(found.size()), near_(near_enough * at.geometry.unit)
    {
    }

    void over(const FlatTriangle& triangle)
    {
        const TriangleAxis axis = triangle_axis(part_, mesh_, triangle, near_, near_);
        if (axis.distance > near_) {
            return;
        }
        deepest_ = std::min(axis.distance, 0.0) - near_;
        lowest_ = infinity;
        corners_over(triangle);
        for (std::size_t k = 0; k < 3; ++k) {
            mesh_corner(triangle.corner[k]);
            if (triangle.crease[k] >= 0) {
                edges_across(triangle.crease[k]);
            }
        }
        if (axis.distance < -near_ && lowest_ > shown * axis.distance) {
            add_axis(axis, triangle);
        }
    }

    void finish() { add_covered(covered_, near_, first_, found_); }

private:
    void add(const Feature& feature)
    {
        const Touch touch = touch_of(feature, at_);
        if (touch.gap > near_ || touch.gap < deepest_) {
            return;
        }
        lowest_ = std::min(lowest_, touch.gap);
        const bool known =
            std::any_of(found_.begin() + static_cast<std::ptrdiff_t>(first_), found_.end(),
                        [&](const Candidate& c) { return c.feature == feature; });
        if (!known) {
            found_.push_back({feature, touch});
        }
    }

    Feature feature(FeatureKind kind) const { return {pair_.a, pair_.b, kind}; }

    Feature corner_feature(int corner, int patch) const
    {
        Feature f = feature(FeatureKind::corner_plane);
        f.i = part_.solid.first_corner + corner;
        f.f = patch;
        return f;
    }

    void corners_over(const FlatTriangle& triangle)
    {
        const double tolerance = rim_tolerance * part_.solid.reach;
        for (std::size_t k = 0; k < part_.corners.size(); ++k) {
            if (past_sides(triangle, part_.corners[k]) <= tolerance) {
                add(corner_feature(static_cast<int>(k), triangle.patch));
            }
        }
    }

    void mesh_corner(int corner)
    {
        const MeshCorner& c = mesh_.corners[hyoryu::at(corner)];
        if (!c.sharp) {
            return;
        }
        const Vec3 p = in_frame(part_.pose, c.point);
        for (std::size_t f = 0; f < part_.solid.faces.size(); ++f) {
            if (past_sides(part_.solid.faces[f], p) <= rim_tolerance * part_.solid.reach &&
                in_cone(mesh_, c, -part_.normals[f]) &&
                face_is_open(part_.whole, part_.solid, static_cast<int>(f), p)) {
                Feature found = feature(FeatureKind::face_corner);
                found.i = corner;
                found.f = part_.solid.first_face + static_cast<int>(f);
                add(found);
            }
        }
    }

    void edges_across(int number_of_crease)
    {
        const Crease& crease = mesh_.creases[hyoryu::at(number_of_crease)];
        const Vec3& q = mesh_.corners[hyoryu::at(crease.i)].point;
        const Vec3 w = mesh_.corners[hyoryu::at(crease.j)].point - q;
        for (const Edge& edge : part_.solid.edges) {
            const Vec3& p = part_.corners[hyoryu::at(edge.i)];
            const Vec3 u = part_.corners[hyoryu::at(edge.j)] - p;
            const Vec3 cross = u.cross(w);
            const double length = cross.norm();
            if (length <= parallel_edges * u.norm() * w.norm()) {
                continue;
            }
            const Vec3 n = (cross.dot(crease.outward) < 0 ? -1 : 1) / length * cross;
            const double s = (q - p).cross(w).dot(cross) / sq(length);
            const double t = (q - p).cross(u).dot(cross) / sq(length);
            const bool within = std::min(s, t) > edge_end && std::max(s, t) < 1 - edge_end;
            if (within && in_cone(crease, n) && rests_on(part_, edge, n, lying_flat) &&
                edge_is_open(part_.whole, part_.solid, edge, in_frame(part_.pose, p + s * u))) {
                Feature found = feature(FeatureKind::edge_crease);
                found.i = part_.solid.first_corner + edge.i;
                found.j = part_.solid.first_corner + edge.j;
                found.k = number_of_crease;
                add(found);
            }
        }
    }

    // Adds the contact of the separating axis if no pair of features represents a deep overlap.
    void add_axis(const TriangleAxis& axis, const FlatTriangle& triangle)
    {
        if (axis.kind == TriangleAxis::Kind::face) {
            Feature found = feature(FeatureKind::face_corner);
            found.i = triangle.corner[hyoryu::at(axis.corner)];
            found.f = part_.solid.first_face + axis.index;
            add(found);
            return;
        }
        const Feature found = corner_feature(axis.corner, triangle.patch);
        const Touch touch = touch_of(found, at_);
        if (touch.gap < deepest_ &&
            ends_inwards(triangle, part_.corners[hyoryu::at(axis.corner)])) {
            covered_.push_back({found, touch});
        }
        add(found);
    }

    // Whether a point leaves the triangle only across flat or concave edges; it is then above or
    // inside the next triangle.
    static bool ends_inwards(const FlatTriangle& t, const Vec3& p)
    {
        bool inwards = true;
        for (std::size_t k = 0; k < 3; ++k) {
            inwards = inwards && (t.crease[k] < 0 || t.sideways[k].dot(p - t.point[k]) <= 0);
        }
        return inwards;
    }

    const BodyPair& pair_;
    const Configuration& at_;
    const MeshTable& mesh_;
    const PartAt& part_;
    std::vector<Candidate>& found_;
    std::vector<Candidate> covered_;
    std::size_t first_;
    double near_; // [m]
    double deepest_ = 0;
    double lowest_ = infinity;
};

} // namespace

void find_mesh_candidates(const BodyPair& pair, const Configuration& at,
                          std::vector<Candidate>& found)
{
    const Solid& solid = at.geometry.solids[hyoryu::at(pair.a)];
    const ContactWall& wall = at.geometry.walls[hyoryu::at(-1 - pair.b)];
    if (solid.form == Form::ball || solid.form == Form::rod) {
        find_round_on_mesh(pair, at, found);
        return;
    }
    std::vector<int> near;
    for (const Solid& own : convex_parts(solid)) {
        const PartAt part =
            part_at(solid, own, at.poses[hyoryu::at(pair.a)], displacement(wall.motion, at.time));
        PartSearch search(pair, at, part, found);
        find_near(wall.mesh.tree, part.box.grown(near_enough * at.geometry.unit), near);
        for (const int t : near) {
            search.over(wall.mesh.triangles[hyoryu::at(t)]);
        }
        search.finish();
    }
}

double mesh_distance(const BodyPair& pair, const Configuration& at)
{
    const Solid& solid = at.geometry.solids[hyoryu::at(pair.a)];
    const ContactWall& wall = at.geometry.walls[hyoryu::at(-1 - pair.b)];
    const double touch = near_enough * at.geometry.unit;
    double smallest = infinity;
    std::vector<int> near;
    for (const Solid& own : convex_parts(solid)) {
        const PartAt part =
            part_at(solid, own, at.poses[hyoryu::at(pair.a)], displacement(wall.motion, at.time));
        find_near(wall.mesh.tree, part.box, near);
        for (const int t : near) {
            const FlatTriangle& triangle = wall.mesh.triangles[hyoryu::at(t)];
            smallest = std::min(smallest,
                                triangle_axis(part, wall.mesh, triangle, smallest, touch).distance);
        }
    }
    return smallest;
}

} // namespace hyoryu
