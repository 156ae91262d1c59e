// SPDX-License-Identifier: MIT
// Every function takes the rod first and gives the normal towards it. A gap is the distance along
// the normal n at which the two features are farthest apart, or overlap least: it is stationary in
// n, and n comes without the difference of two points that touch.
#include "rod_touch.hpp"
#include "ellipse.hpp"
#include "tolerances.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hyoryu {

namespace {

// Lines within this sine of parallel touch at their ends, where their distance exceeds that at the
// crossing by at most 1e-11 m.
constexpr double parallel_lines = 1e-5;
// Sine below which the crossing of two lines is noise.
constexpr double one_direction = 1e-9;
// Most Newton steps, and halvings of a step; a few are typical.
constexpr int newton_steps_of_touch = 40;
constexpr int most_halvings = 20;
// A normal nearer to the axis than this is that of the cap; no unique point of the rim then touches
// (unit vectors).
constexpr double along_axis = 1e-5;
// A normal nearer to an axis than this may be stuck at the axis, where the gap is not
// differentiable.
constexpr double near_axis = 1e-2;
constexpr double longest_step = 0.4; // about the distance of two samples [rad]
// Round-off of an angle, and as a part of a length.
constexpr double round_off_of_angle = 1e-14;

// An edge, or the axis of a rod with its radius.
struct EdgeOrAxis {
    Vec3 from{0, 0, 0};
    Vec3 along{1, 0, 0}; // unit
    double length = 0;   // [m]
    double radius = 0;   // [m]

    double past(double s) const { return std::max(-s, s - length); }
};

struct Rim {
    Vec3 centre{0, 0, 0};
    Vec3 axis{1, 0, 0}; // unit
    double radius = 0;  // [m]

    // The radius that points most along n.
    Vec3 towards(const Vec3& n) const
    {
        const Vec3 across = n - axis * axis.dot(n);
        return radius / std::max(across.norm(), no_direction) * across;
    }
};

Vec3 any_square_to(const Vec3& n)
{
    int smallest = 0;
    n.cwiseAbs().minCoeff(&smallest);
    return n.cross(Vec3::Unit(smallest)).normalized();
}

Vec3 direction(const Vec3& v)
{
    return v.squaredNorm() > 0 ? Vec3(v.normalized()) : Vec3(Vec3::UnitZ());
}

EdgeOrAxis side_of(const PlacedSolid& rod)
{
    const Vec3 axis = rod.pose.R.col(0);
    const double half = rod.solid.half_length;
    return {rod.pose.x - half * axis, axis, 2 * half, rod.solid.radius};
}

// The side of its rod that a cap is on.
int out_of(int cap)
{
    return cap == 0 ? -1 : 1;
}

Rim rim_of(const PlacedSolid& rod, int i)
{
    const Vec3 axis = rod.pose.R.col(0);
    return {rod.pose.x + out_of(i) * rod.solid.half_length * axis, axis, rod.solid.radius};
}

EdgeOrAxis line_between(const Vec3& p, const Vec3& q)
{
    const double length = (q - p).norm();
    return {p, (q - p) / length, length, 0};
}

// The nearest points of the two segments, Ericson (2005), 5.1.9: beyond the ends the gap is that of
// the ends, whereas the normal of the infinite lines becomes meaningless.
RodTouch side_on_line(const EdgeOrAxis& side, const EdgeOrAxis& line)
{
    const Vec3 cross = side.along.cross(line.along);
    const double sine = cross.norm();
    const Vec3 r = side.from - line.from;
    const bool lost = sine <= one_direction;
    const double s0 = lost ? 0.5 * side.length : line.along.cross(r).dot(cross) / sq(sine);
    const double t0 = lost ? 0.5 * line.length : side.along.cross(r).dot(cross) / sq(sine);
    double s = std::clamp(s0, 0.0, side.length);
    const double t = std::clamp(line.along.dot(r + s * side.along), 0.0, line.length);
    s = std::clamp(side.along.dot(t * line.along - r), 0.0, side.length);
    const Vec3 apart = r + s * side.along - t * line.along;
    const Vec3 n = direction(apart);
    const double gap = apart.norm() - side.radius - line.radius;
    const Vec3 point = line.from + t * line.along + (line.radius + 0.5 * gap) * n;
    return {{point, n, gap},
            sine <= parallel_lines ? infinity : std::max(side.past(s0), line.past(t0))};
}

// Seen along the line, the rim is an ellipse and the line a point. One long side of the ellipse is
// the half of the rim on which the line enters the cap (end -1), the other that on which it leaves
// (end 1): where the line rocks over the cap, these sides change places, and each end stays where
// it is. At the end that lies behind the other one the normal points into the rod.
RodTouch rim_on_line(const PlacedSolid& rod, int i, const EdgeOrAxis& line, int end)
{
    const Rim rim = rim_of(rod, i);
    const Vec3 out = out_of(i) * rim.axis;
    const Vec3 cross = out.cross(line.along);
    const double sine = cross.norm();
    const Vec3 major = sine > no_direction ? Vec3(cross / sine) : any_square_to(line.along);
    const Vec3 minor = line.along.cross(major);
    const Vec3 r = line.from - rim.centre;
    const double x = major.dot(r) / rim.radius;
    const double y = minor.dot(r) / rim.radius;
    const double beta = -end * out.dot(line.along);
    const std::optional<Foot> foot = upper_foot(x, y, beta);
    if (!foot) { // behind the rod
        RodTouch other = rim_on_line(rod, i, line, -end);
        other.past = infinity;
        return other;
    }
    const Vec3 n = (foot->normal.x() * major + foot->normal.y() * minor).normalized();
    const Vec3 on_rim = rim.centre + rim.radius * (foot->angle.x() * major +
                                                   end * foot->angle.y() * major.cross(out));
    const double gap = n.dot(line.from - on_rim) - line.radius;
    const double past = line.past(line.along.dot(on_rim - line.from));
    return {{on_rim + 0.5 * gap * n, -n, gap}, past};
}

// Where the rims of two caps cross, seen along the axis of the first: on the line of equal power to
// both circles.
RodTouch cap_on_cap(const Rim& rim, int side, const Rim& other, int end)
{
    const Vec3 n = side * rim.axis;
    const Vec3 d = other.centre - rim.centre;
    const Vec3 apart = d - n * n.dot(d);
    const double distance = apart.norm();
    const double power =
        0.5 * (distance + (sq(rim.radius) - sq(other.radius)) / std::max(distance, no_direction));
    const double root = sq(rim.radius) - sq(power);
    const Vec3 towards = direction(apart);
    const Vec3 p = power * towards + end * std::sqrt(std::max(root, 0.0)) * n.cross(towards);
    const Vec3 into = (other.axis.dot(n) < 0 ? -1 : 1) * other.axis;
    return {{rim.centre + p, -into, into.dot(d - p)}, root > 0 ? 0 : infinity};
}

// Distance of the discs within two rims along n, from the first to the second.
struct DiscGap {
    const Rim& a;
    const Rim& b;

    Vec3 on_a(const Vec3& n) const { return a.centre + a.towards(n); }
    Vec3 on_b(const Vec3& n) const { return b.centre - b.towards(n); }
    double along(const Vec3& n) const { return n.dot(on_b(n) - on_a(n)); }
    // Gradient on the sphere of normals; `left_out` 0 omits the radius of the first disc, 1 of the
    // second.
    Vec3 slope(const Vec3& n, int left_out) const
    {
        const Vec3 d = (left_out == 1 ? b.centre : on_b(n)) - (left_out == 0 ? a.centre : on_a(n));
        return d - n * n.dot(d);
    }
    const Rim& disc(int k) const { return k == 0 ? a : b; }
};

// Moves n along the sphere if the gap grows, halving the step after each failed attempt.
bool climb(const DiscGap& discs, const Vec3& step, Vec3& n)
{
    const double gap = discs.along(n);
    double part = std::min(1.0, longest_step / std::max(step.norm(), round_off_of_angle));
    for (int h = 0; h < most_halvings; ++h, part *= 0.5) {
        const Vec3 next = (n + part * step).normalized();
        if (discs.along(next) > gap) {
            n = next;
            return true;
        }
    }
    return false;
}

Vec3 newton_step(const DiscGap& discs, const Vec3& n)
{
    Eigen::Matrix<double, 3, 2> plane;
    plane.col(0) = any_square_to(n);
    plane.col(1) = n.cross(plane.col(0));
    Eigen::Matrix2d bend = std::max(discs.along(n), 0.0) * Eigen::Matrix2d::Identity();
    for (const int k : {0, 1}) {
        const Vec3 across = discs.disc(k).axis.cross(n);
        const double length = std::max(across.norm(), no_direction);
        const Eigen::Vector2d t = plane.transpose() * across / length;
        bend += discs.disc(k).radius / length *
                (t * t.transpose() + round_off_of_angle * Eigen::Matrix2d::Identity());
    }
    return plane * (bend.inverse() * (plane.transpose() * discs.slope(n, -1)));
}

// The normal of the widest gap, which is concave where it is positive: Newton's method on the
// sphere converges from any start, except at the axes of the discs, where the gap is not
// differentiable.
Vec3 widest(const DiscGap& discs, Vec3 n)
{
    for (int k = 0; k < newton_steps_of_touch; ++k) {
        Vec3 step = newton_step(discs, n);
        if (climb(discs, step, n)) {
            if (step.norm() <= round_off_of_angle) {
                return n;
            }
            continue;
        }
        bool left = false;
        for (int m = 0; m < 2 && !left; ++m) {
            const Rim& disc = discs.disc(m);
            const Vec3 slope = discs.slope(n, m);
            if (disc.axis.cross(n).norm() < near_axis && slope.norm() > disc.radius) {
                left = climb(discs, longest_step / slope.norm() * slope, n);
            }
        }
        if (!left) {
            return n;
        }
    }
    return n;
}

// Of the normals between the rims at some points of the second, out of both caps, the one of the
// widest gap.
Vec3 first_normal(const DiscGap& discs, int i, const PlacedSolid& b, int j)
{
    const Vec3 across = direction(discs.b.centre - discs.a.centre);
    if (discs.along(across) > 0) { // concave: `climb` then finds the only maximum
        return across;
    }
    Vec3 best = direction(out_of(i) * discs.a.axis - out_of(j) * discs.b.axis);
    double widest_gap = discs.along(best);
    const auto look = [&](const Vec3& n) {
        const double gap = discs.along(n);
        if (gap > widest_gap && out_of(i) * n.dot(discs.a.axis) >= 0 &&
            out_of(j) * n.dot(discs.b.axis) <= 0) {
            widest_gap = gap;
            best = n;
        }
    };
    for (const int corner : b.solid.faces[j].corners) {
        const Vec3 q = b.pose.x + b.pose.R * b.solid.corners[corner];
        const Vec3 p = discs.a.centre + discs.a.towards(q - discs.a.centre);
        const Vec3 u = discs.a.axis.cross(p - discs.a.centre);
        const Vec3 n = direction(u.cross(discs.b.axis.cross(q - discs.b.centre)));
        look(n);
        look(-n);
        look(direction(q - p));
    }
    return best;
}

RodTouch rim_on_rim(const PlacedSolid& a, int i, const PlacedSolid& b, int j)
{
    const Rim of_a = rim_of(a, i);
    const Rim of_b = rim_of(b, j);
    const DiscGap discs{of_a, of_b};
    const Vec3 n = widest(discs, first_normal(discs, i, b, j));
    const Vec3 d = discs.on_b(n) - discs.on_a(n);
    const double gap = n.dot(d);
    const bool on_cap = std::min(of_a.axis.cross(n).norm(), of_b.axis.cross(n).norm()) < along_axis;
    return {{0.5 * (discs.on_a(n) + discs.on_b(n)), -n, gap},
            on_cap ? infinity : (d - gap * n).norm()};
}

Touch over_face(const Vec3& point, const PlacedSolid& other, int f)
{
    const Face& face = other.solid.faces[f];
    const Vec3 n = other.pose.R * face.normal;
    return {point, n, n.dot(point - other.pose.x) - face.offset};
}

// The partner of a rod: another solid, or the creases and corners of a mesh.
struct Partner {
    PlacedSolid solid;
    const MeshTable* mesh = nullptr;
    Vec3 shift{0, 0, 0}; // of the mesh

    Vec3 corner(int k) const
    {
        return mesh ? Vec3(mesh->corners[k].point + shift)
                    : Vec3(solid.pose.x + solid.pose.R * solid.solid.corners[k]);
    }
    EdgeOrAxis line(const Feature& feature) const
    {
        if (mesh) {
            const Crease& crease = mesh->creases[feature.k];
            return line_between(corner(crease.i), corner(crease.j));
        }
        if (solid.solid.form == Form::rod) {
            return side_of(solid);
        }
        return line_between(corner(feature.k), corner(feature.l));
    }
};

Partner partner(const Configuration& at, int index)
{
    if (index >= 0 || at.geometry.walls[-1 - index].mesh.triangles.empty()) {
        return {placed(at, index)};
    }
    const ContactWall& wall = at.geometry.walls[-1 - index];
    return {placed(at, index), &wall.mesh, displacement(wall.motion, at.time)};
}

RodTouch corner_touch(const PlacedSolid& rod, const Vec3& corner)
{
    const Touch local = nearest(rod.solid, rod.pose.R.transpose() * (corner - rod.pose.x));
    return {{corner, -(rod.pose.R * local.normal), local.gap}};
}

RodTouch touch_on_rod(const Feature& feature, const PlacedSolid& rod, const Partner& other)
{
    switch (feature.kind) {
    case FeatureKind::rim_face: {
        const Vec3 n = other.solid.pose.R * other.solid.solid.faces[feature.f].normal;
        return {over_face(low_point(rod, feature.i, n), other.solid, feature.f)};
    }
    case FeatureKind::cap_cap:
        return cap_on_cap(rim_of(rod, feature.i), feature.i == 0 ? -1 : 1,
                          rim_of(other.solid, feature.k), feature.j == 0 ? -1 : 1);
    case FeatureKind::rod_corner:
        return corner_touch(rod, other.corner(feature.k));
    case FeatureKind::side_line:
        return side_on_line(side_of(rod), other.line(feature));
    case FeatureKind::rim_line:
        return rim_on_line(rod, feature.i, other.line(feature), feature.j == 0 ? -1 : 1);
    default:
        return rim_on_rim(rod, feature.i, other.solid, feature.j);
    }
}

} // namespace

Vec3 low_point(const PlacedSolid& rod, int i, const Vec3& n)
{
    const Rim rim = rim_of(rod, i);
    const Vec3 down = rim.axis * rim.axis.dot(n) - n;
    const double length = down.norm();
    return rim.centre +
           rim.radius * (length > no_direction ? Vec3(down / length) : Vec3(rod.pose.R.col(1)));
}

double rod_triangle_distance(const PlacedSolid& rod, const std::array<Vec3, 3>& triangle)
{
    const Vec3 axis = rod.pose.R.col(0);
    double distance = -infinity;
    const auto look = [&](const Vec3& n) { // towards the rod
        const double along = n.dot(axis);
        const double lowest = n.dot(rod.pose.x) - rod.solid.half_length * std::abs(along) -
                              rod.solid.radius * axis.cross(n).norm();
        const double highest =
            std::max({n.dot(triangle[0]), n.dot(triangle[1]), n.dot(triangle[2])});
        distance = std::max(distance, lowest - highest);
    };
    const Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
    for (const Vec3& n : {normal, Vec3(-normal), axis, Vec3(-axis)}) {
        look(n);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const EdgeOrAxis edge = line_between(triangle[k], triangle[(k + 1) % 3]);
        look(corner_touch(rod, triangle[k]).touch.normal);
        look(side_on_line(side_of(rod), edge).touch.normal);
        for (const int i : {0, 1}) {
            const int end = out_of(i) * axis.dot(edge.along) > 0 ? -1 : 1;
            look(rim_on_line(rod, i, edge, end).touch.normal);
        }
    }
    return distance;
}

RodTouch rod_touch(const Feature& feature, const Configuration& at)
{
    const bool owner_is_a = feature.owner == 0;
    const PlacedSolid rod = placed(at, owner_is_a ? feature.a : feature.b);
    RodTouch found = touch_on_rod(feature, rod, partner(at, owner_is_a ? feature.b : feature.a));
    if (!owner_is_a) {
        found.touch.normal = -found.touch.normal;
    }
    return found;
}

} // namespace hyoryu
