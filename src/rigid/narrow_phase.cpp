// SPDX-License-Identifier: MIT
#include "narrow_phase.hpp"
#include "manifold.hpp"
#include "separation.hpp"

#include <cmath>

namespace hyoryu {

namespace {

// A rod stands on its rim rather than lies if its axis is nearer to the normal than acos of this.
constexpr double standing = 0.995;
constexpr int rim_points = 8; // as in gap.cpp

void add(const Feature& feature, const Configuration& at, std::vector<Candidate>& found)
{
    found.push_back({feature, touch_of(feature, at)});
}

// A point that a thin side does not hold: past its extent, or so far behind that it is outside.
bool past(const HalfSpace& plane, const Wall& wall, const Vec3& point, double time)
{
    const Vec3 p = point - displacement(wall.motion, time);
    return ((p - plane.lower).array() < 0).any() || ((p - plane.upper).array() > 0).any();
}

void add_to_plane(const Feature& feature, const HalfSpace& plane, const Configuration& at,
                  std::vector<Candidate>& found)
{
    const Touch touch = touch_of(feature, at);
    if (past(plane, at.geometry.walls[-1 - feature.b], touch.point, at.time)) {
        return;
    }
    const bool beyond = touch.gap < -plane.slack * at.geometry.solids[feature.a].reach;
    found.push_back({feature, touch, beyond});
}

void rod_on_plane(Feature feature, const HalfSpace& plane, const Configuration& at,
                  std::vector<Candidate>& found)
{
    const double upright = at.poses[feature.a].R.col(0).dot(plane.normal);
    for (feature.i = 0; feature.i < 2; ++feature.i) {
        feature.kind = FeatureKind::rim_low;
        feature.j = 0;
        add_to_plane(feature, plane, at, found);
        const bool lower_end = (upright > 0) == (feature.i == 0);
        feature.kind = FeatureKind::rim_fixed;
        for (feature.j = 0; std::abs(upright) > standing && lower_end && feature.j < rim_points;
             ++feature.j) {
            add_to_plane(feature, plane, at, found);
        }
    }
}

void on_half_spaces(const Pair& pair, const Configuration& at, std::vector<Candidate>& found)
{
    const Solid& solid = at.geometry.solids[pair.a];
    for (const HalfSpace& plane : at.geometry.walls[-1 - pair.b].half_spaces) {
        Feature feature{pair.a, pair.b};
        feature.f = plane.side;
        if (solid.form == Form::ball) {
            feature.kind = FeatureKind::ball_plane;
            add_to_plane(feature, plane, at, found);
        } else if (solid.form == Form::rod) {
            rod_on_plane(feature, plane, at, found);
        } else {
            for (feature.i = 0; feature.i < static_cast<int>(solid.corners.size()); ++feature.i) {
                add_to_plane(feature, plane, at, found);
            }
        }
    }
}

bool on_planes(const Pair& pair, const Geometry& geometry)
{
    return pair.b < 0 && !geometry.walls[-1 - pair.b].half_spaces.empty();
}

Form form_of(int index, const Geometry& geometry)
{
    return index >= 0 ? geometry.solids[index].form : geometry.walls[-1 - index].solid.form;
}

} // namespace

bool has_axis(const Pair& pair, const Geometry& geometry)
{
    return !on_planes(pair, geometry) && form_of(pair.a, geometry) != Form::ball &&
           form_of(pair.b, geometry) != Form::ball;
}

double axis_distance(const Pair& pair, const Configuration& at)
{
    const Placed a = placed(at, pair.a);
    const Placed b = placed(at, pair.b);
    const double apart = (a.pose.x - b.pose.x).norm() - a.solid.reach - b.solid.reach;
    return apart > 0 ? apart : separation(a, b, clearly_apart).distance;
}

void find_candidates(const Pair& pair, const Configuration& at, double near,
                     std::vector<Candidate>& found)
{
    if (on_planes(pair, at.geometry)) {
        on_half_spaces(pair, at, found);
    } else if (has_axis(pair, at.geometry)) {
        const Placed a = placed(at, pair.a);
        const Placed b = placed(at, pair.b);
        if ((a.pose.x - b.pose.x).norm() > a.solid.reach + b.solid.reach + near) {
            return;
        }
        const Separation axis = separation(a, b, near);
        if (axis.distance <= near) {
            add_manifold(pair, axis, at, found);
        }
    } else {
        Feature feature{pair.a, pair.b, FeatureKind::round};
        feature.owner = form_of(pair.a, at.geometry) == Form::ball ? 0 : 1;
        add(feature, at, found);
    }
}

} // namespace hyoryu
