// SPDX-License-Identifier: MIT
#include "mesh_ball_rod.hpp"
#include "mesh_contact.hpp"
#include "rod_touch.hpp"
#include "tolerances.hpp"

#include <algorithm>
#include <optional>

namespace hyoryu {

namespace {

AlignedBox box_of(const Solid& solid, const SolidPose& pose)
{
    const Vec3 half =
        solid.form == Form::ball ? solid.box_half : Vec3(pose.R.cwiseAbs() * solid.box_half);
    return {pose.x - half, pose.x + half};
}

class RoundSearch {
public:
    RoundSearch(const BodyPair& pair, const Configuration& at, std::vector<Candidate>& found)
        : pair_(pair), at_(at), wall_(at.geometry.walls[hyoryu::at(-1 - pair.b)]),
          mesh_(wall_.mesh), solid_(at.geometry.solids[hyoryu::at(pair.a)]),
          pose_(placed(at, pair.a).pose), found_(found), first_(found.size())
    {
        pose_.x -= displacement(wall_.motion, at.time);
    }

    void search()
    {
        std::vector<int> near;
        find_near(mesh_.tree, box_of(solid_, pose_).grown(deep * at_.geometry.unit), near);
        for (const int t : near) {
            const FlatTriangle& triangle = mesh_.triangles[hyoryu::at(t)];
            const Patch& patch = mesh_.patches[hyoryu::at(triangle.patch)];
            if (patch.normal.dot(pose_.x) <= patch.offset) {
                continue;
            }
            if (solid_.form == Form::ball) {
                ball_over(triangle);
            } else {
                rod_over(triangle, patch);
                show_overlap(triangle, patch);
            }
        }
    }

private:
    Feature feature(FeatureKind kind) const { return {pair_.a, pair_.b, kind}; }

    void add(const Feature& f)
    {
        const bool known =
            std::any_of(found_.begin() + static_cast<std::ptrdiff_t>(first_), found_.end(),
                        [&](const Candidate& c) { return c.feature == f; });
        if (!known) {
            found_.push_back({f, touch_of(f, at_)});
        }
    }

    // Whether a feature of the rod belongs to this triangle: a feature much deeper than the overlap
    // of rod and triangle lies behind another triangle.
    bool faces(const FlatTriangle& triangle, double gap)
    {
        const double slack = deep * at_.geometry.unit;
        if (gap < -slack && !distance_) {
            distance_ = rod_triangle_distance({solid_, pose_}, triangle.point);
        }
        const bool so = gap >= -slack || gap >= 2 * std::min(*distance_, 0.0) - slack;
        lowest_ = so ? std::min(lowest_, gap) : lowest_;
        return so;
    }

    // Adds the low point of the rod if no pair of features represents a deep overlap.
    void show_overlap(const FlatTriangle& triangle, const Patch& patch)
    {
        Feature f = feature(FeatureKind::rim_low);
        f.f = triangle.patch;
        const auto height = [&](int rim) {
            return patch.normal.dot(low_point({solid_, pose_}, rim, patch.normal)) - patch.offset;
        };
        f.i = height(0) < height(1) ? 0 : 1;
        const double low = height(f.i);
        if (lowest_ < 0 || low >= -deep * at_.geometry.unit) {
            return;
        }
        if (!distance_) {
            distance_ = rod_triangle_distance({solid_, pose_}, triangle.point);
        }
        if (*distance_ < -deep * at_.geometry.unit) {
            add(f);
        }
    }

    // Adds the contact of a ball whose centre is in the Voronoi region of the face, a crease or a
    // corner.
    void ball_over(const FlatTriangle& triangle)
    {
        if (past_sides(triangle, pose_.x) <= 0) {
            Feature f = feature(FeatureKind::ball_plane);
            f.f = triangle.patch;
            add(f);
            return;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            if (triangle.crease[k] >= 0) {
                ball_at(mesh_.creases[hyoryu::at(triangle.crease[k])], triangle.crease[k]);
            }
            const MeshCorner& corner = mesh_.corners[hyoryu::at(triangle.corner[k])];
            if (corner.sharp && in_cone(mesh_, corner, (pose_.x - corner.point).normalized())) {
                Feature f = feature(FeatureKind::round_corner);
                f.i = triangle.corner[k];
                add(f);
            }
        }
    }

    void ball_at(const Crease& crease, int k)
    {
        const Vec3& a = mesh_.corners[hyoryu::at(crease.i)].point;
        const Vec3 d = mesh_.corners[hyoryu::at(crease.j)].point - a;
        const double t = d.dot(pose_.x - a) / d.squaredNorm();
        const Vec3 out = pose_.x - a - t * d;
        if (t > 0 && t < 1 && out.dot(crease.left) < 0 && out.dot(crease.right) < 0) {
            Feature f = feature(FeatureKind::round_crease);
            f.k = k;
            add(f);
        }
    }

    void rod_over(const FlatTriangle& triangle, const Patch& patch)
    {
        distance_.reset();
        lowest_ = infinity;
        Feature f = feature(FeatureKind::rim_low);
        f.f = triangle.patch;
        for_low_features(f, solid_, pose_.R.col(0).dot(patch.normal),
                         [&](const Feature& low) { add_rim(low, triangle); });
        for (std::size_t k = 0; k < 3; ++k) {
            if (triangle.crease[k] >= 0) {
                rod_on(triangle, triangle.crease[k]);
            }
            rod_at(triangle, triangle.corner[k]);
        }
    }

    // A deep overlap counts only if its point lies well within the sides of the triangle.
    void add_rim(const Feature& f, const FlatTriangle& triangle)
    {
        const Touch touch = touch_of(f, at_);
        const double rim = rim_tolerance * solid_.reach;
        const Vec3 point = touch.point - displacement(wall_.motion, at_.time);
        if (past_sides(triangle, point) <= (touch.gap < -deep * at_.geometry.unit ? -rim : rim) &&
            faces(triangle, touch.gap)) {
            add(f);
        }
    }

    void rod_on(const FlatTriangle& triangle, int k)
    {
        const Crease& crease = mesh_.creases[hyoryu::at(k)];
        Feature f = feature(FeatureKind::side_line);
        f.k = k;
        add_curve(triangle, f, crease);
        for (f.i = 0; f.i < 2; ++f.i) {
            f.kind = FeatureKind::rim_line;
            for (f.j = 0; f.j < 2; ++f.j) {
                add_curve(triangle, f, crease);
            }
            f.j = 0;
        }
    }

    // A rim has only the normals between those of its cap and the side. If the rod extends beyond
    // the point along the normal, by twice `inward`, the point is rejected.
    void add_curve(const FlatTriangle& triangle, const Feature& f, const Crease& crease)
    {
        const RodTouch found = rod_touch(f, at_);
        const Vec3& n = found.touch.normal;
        const Vec3 axis = pose_.R.col(0);
        const double outward = (f.i == 0 ? 1 : -1) * axis.dot(n);
        const Vec3 point = found.touch.point - displacement(wall_.motion, at_.time) - pose_.x;
        const double inward = n.dot(point - axis * axis.dot(point));
        const bool of_rod = f.kind == FeatureKind::side_line ||
                            (outward >= -lying_flat && 2 * inward <= deep * at_.geometry.unit);
        if (of_rod && found.past <= rim_tolerance * solid_.reach && in_cone(crease, n) &&
            faces(triangle, found.touch.gap)) {
            add(f);
        }
    }

    void rod_at(const FlatTriangle& triangle, int k)
    {
        const MeshCorner& corner = mesh_.corners[hyoryu::at(k)];
        Feature f = feature(FeatureKind::rod_corner);
        f.k = k;
        if (corner.sharp) {
            const Touch touch = touch_of(f, at_);
            if (in_cone(mesh_, corner, touch.normal) && faces(triangle, touch.gap)) {
                add(f);
            }
        }
    }

    const BodyPair& pair_;
    const Configuration& at_;
    const ContactWall& wall_;
    const MeshTable& mesh_;
    const Solid& solid_;
    SolidPose pose_; // in the axes of the mesh at time 0
    std::vector<Candidate>& found_;
    std::size_t first_;
    std::optional<double> distance_; // of the rod and the triangle in hand [m]
    double lowest_ = infinity;       // gap of a feature of it [m]
};

} // namespace

void find_round_on_mesh(const BodyPair& pair, const Configuration& at,
                        std::vector<Candidate>& found)
{
    RoundSearch(pair, at, found).search();
}

} // namespace hyoryu
