// SPDX-License-Identifier: MIT
// Every function takes the rod first and gives the normal towards it. A gap is the distance along
// the normal n at which the two features are farthest apart, or overlap least: it is stationary in
// n, and n comes without the difference of two points that touch.
#include "rod_touch.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Shorter than this a direction is noise and a fixed one takes its place (unit vectors).
constexpr double no_direction = 1e-9;
// Lines this near to parallel (sine) touch by their ends, which are then 1e-11 m at most farther
// apart than the lines where they cross.
constexpr double parallel_lines = 1e-5;
// Newton steps and halvings of one of them; a handful is the rule.
constexpr int most_steps = 40;
constexpr int most_halvings = 20;
// Tangents of two rims are parallel below this sine: the rims meet in no single point.
constexpr double parallel_tangents = 1e-6;
// A normal nearer to the axis than this is that of the cap, and the rim has no one point (unit
// vectors).
constexpr double flat = 1e-5;
constexpr double longest_step = 0.4; // about what lies between two samples [rad]
// Round-off of an angle, and as a part of a length.
constexpr double round_off = 1e-14;

// An edge, or the axis of a rod with its radius.
struct Line {
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

Line side_of(const PlacedSolid& rod)
{
    const Vec3 axis = rod.pose.R.col(0);
    const double half = rod.solid.half_length;
    return {rod.pose.x - half * axis, axis, 2 * half, rod.solid.radius};
}

Rim rim_of(const PlacedSolid& rod, int i)
{
    const Vec3 axis = rod.pose.R.col(0);
    return {rod.pose.x + (i == 0 ? -1 : 1) * rod.solid.half_length * axis, axis, rod.solid.radius};
}

Line line_between(const Vec3& p, const Vec3& q)
{
    const double length = (q - p).norm();
    return {p, (q - p) / length, length, 0};
}

// The nearest points of the two segments, Ericson (2005), 5.1.9: beyond the ends the gap goes on as
// that of the ends, while the normal of the whole lines would turn to nowhere.
RodTouch side_on_line(const Line& side, const Line& line)
{
    const Vec3 cross = side.along.cross(line.along);
    const double sine = cross.norm();
    const Vec3 r = side.from - line.from;
    const bool parallel = sine <= parallel_lines;
    const double s0 = parallel ? 0.5 * side.length : line.along.cross(r).dot(cross) / sq(sine);
    const double t0 = parallel ? 0.5 * line.length : side.along.cross(r).dot(cross) / sq(sine);
    double s = std::clamp(s0, 0.0, side.length);
    const double t = std::clamp(line.along.dot(r + s * side.along), 0.0, line.length);
    s = std::clamp(side.along.dot(t * line.along - r), 0.0, side.length);
    const Vec3 apart = r + s * side.along - t * line.along;
    const Vec3 n = direction(apart);
    const double gap = apart.norm() - side.radius - line.radius;
    const Vec3 point = line.from + t * line.along + (line.radius + 0.5 * gap) * n;
    return {{point, n, gap}, parallel ? infinity : std::max(side.past(s0), line.past(t0))};
}

// The normal of the ellipse (x/1)^2 + (y/beta)^2 = 1, kappa = 1 - beta^2, through the point (x, y)
// with x, y >= 0: the largest root s of (x/(s + kappa))^2 + (beta y/s)^2 = 1, on which Newton's
// method closes in from below. Source: Eberly, Distance from a Point to an Ellipse (2013).
Eigen::Vector2d ellipse_normal(double x, double y, double beta, double kappa)
{
    double s = std::max(beta * y, x - kappa);
    if (s <= 0) { // on the major axis, within the centres of curvature
        const double cosine = kappa > 0 ? std::min(x / kappa, 1.0) : 0;
        return {beta * cosine, std::sqrt(1 - sq(cosine))};
    }
    for (int k = 0; k < most_steps; ++k) {
        const double p = sq(x / (s + kappa));
        const double q = sq(beta * y / s);
        const double next = s + 0.5 * (p + q - 1) / (p / (s + kappa) + q / s);
        if (next <= s) {
            break;
        }
        s = next;
    }
    return {x * s, y * (s + kappa)};
}

// Seen along the line, the rim is an ellipse and the line a point.
RodTouch rim_on_line(const Rim& rim, const Line& line)
{
    const Vec3 cross = rim.axis.cross(line.along);
    const double sine = cross.norm();
    const Vec3 major = sine > no_direction ? Vec3(cross / sine) : any_square_to(line.along);
    const Vec3 minor = line.along.cross(major);
    const Vec3 r = line.from - rim.centre;
    const double x = major.dot(r) / rim.radius;
    const double y = minor.dot(r) / rim.radius;
    const double beta = std::abs(rim.axis.dot(line.along));
    const Eigen::Vector2d normal = ellipse_normal(std::abs(x), std::abs(y), beta, sq(sine));
    const Vec3 out = (std::copysign(normal.x(), x) * major + std::copysign(normal.y(), y) * minor)
                         .normalized(); // towards the line
    const double across = rim.axis.cross(out).norm();
    const double gap = out.dot(r) - rim.radius * across - line.radius;
    const Vec3 on_rim = rim.centre + rim.towards(out);
    const double past = across > flat ? line.past(line.along.dot(on_rim - line.from)) : infinity;
    return {{on_rim + 0.5 * gap * out, -out, gap}, past};
}

// Where the line leaves the cap (end 1) or comes over it (end -1), seen along the axis. Where the
// line ends over the cap its end has a touch of its own.
RodTouch line_over_cap(const Rim& rim, int side, const Line& line, int end)
{
    const Vec3 n = side * rim.axis;
    const Vec3 facing = n - line.along * line.along.dot(n);
    const Vec3 r = line.from - line.radius * direction(facing) - rim.centre;
    const Vec3 across = r - n * n.dot(r);
    const Vec3 along = line.along - n * n.dot(line.along);
    const double a = along.squaredNorm();
    const double b = along.dot(across);
    const double root = sq(b) - a * (across.squaredNorm() - sq(rim.radius));
    if (a <= sq(no_direction) || root < 0) {
        return {{rim.centre + r, -n, n.dot(r)}, infinity};
    }
    const double t = (end * std::sqrt(root) - b) / a;
    const Vec3 p = r + t * line.along;
    return {{rim.centre + p, -n, n.dot(p)}, line.past(t)};
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

// A point of a rim, by the arm from its centre.
struct RimPoint {
    Rim rim;
    Vec3 arm{0, 0, 0};

    Vec3 at() const { return rim.centre + arm; }
    Vec3 tangent() const { return rim.axis.cross(arm); } // the change with the angle
    void turn(double angle) { arm = std::cos(angle) * arm + std::sin(angle) * tangent(); }
};

// Of some points of rim j of rod b, the one nearest to rod a.
RimPoint nearest_sample(const PlacedSolid& a, const PlacedSolid& b, int j)
{
    RimPoint best{rim_of(b, j)};
    double smallest = infinity;
    for (const int corner : b.solid.faces[j].corners) {
        const Vec3 arm = b.pose.R * b.solid.corners[corner] + b.pose.x - best.rim.centre;
        const Vec3 p = a.pose.R.transpose() * (best.rim.centre + arm - a.pose.x);
        const double gap = nearest(a.solid, p).gap;
        if (gap < smallest) {
            smallest = gap;
            best.arm = arm;
        }
    }
    return best;
}

// Turns both points to where they are nearest to each other: Newton's method for half the square of
// their distance, by Gauss and Newton where that is not convex.
void approach(RimPoint& p, RimPoint& q)
{
    for (int k = 0; k < most_steps; ++k) {
        const Vec3 d = q.at() - p.at();
        const Vec3 u = p.tangent();
        const Vec3 w = q.tangent();
        const Eigen::Vector2d slope(-d.dot(u), d.dot(w));
        Eigen::Matrix2d bend;
        bend << u.squaredNorm() + d.dot(p.arm), -u.dot(w), -u.dot(w),
            w.squaredNorm() - d.dot(q.arm);
        if (bend.determinant() <= 0 || bend.trace() <= 0) {
            bend << u.squaredNorm(), -u.dot(w), -u.dot(w), w.squaredNorm();
            bend += parallel_tangents * bend.trace() * Eigen::Matrix2d::Identity();
        }
        Eigen::Vector2d step = -(bend.inverse() * slope);
        step *= std::min(1.0, longest_step / step.norm());
        for (int h = 0; h < most_halvings; ++h, step *= 0.5) {
            RimPoint p_next = p;
            RimPoint q_next = q;
            p_next.turn(step[0]);
            q_next.turn(step[1]);
            if ((q_next.at() - p_next.at()).norm() <= d.norm() + round_off * p.rim.radius) {
                p = p_next;
                q = q_next;
                break;
            }
        }
        if (step.norm() <= round_off) {
            return;
        }
    }
}

// The normal is square to both tangents, towards b from the edge of a that the rim is.
RodTouch rim_on_rim(const PlacedSolid& a, int i, const PlacedSolid& b, int j)
{
    RimPoint q = nearest_sample(a, b, j);
    RimPoint p{rim_of(a, i)};
    p.arm = p.rim.towards(q.at() - p.rim.centre);
    approach(p, q);
    const auto outwards = [](const RimPoint& x, int end) {
        return Vec3(x.arm / x.rim.radius + (end == 0 ? -1 : 1) * x.rim.axis);
    };
    const Vec3 d = q.at() - p.at();
    const Vec3 cross = p.tangent().cross(q.tangent());
    const double length = cross.norm();
    if (length <= parallel_tangents * p.rim.radius * q.rim.radius) {
        return {{0.5 * (p.at() + q.at()), -direction(d), d.norm()}, infinity};
    }
    const double sign = cross.dot(outwards(p, i) - outwards(q, j)) < 0 ? -1 : 1;
    const Vec3 n = sign / length * cross;
    const double gap = n.dot(d);
    const bool on_cap = std::min(p.rim.axis.cross(n).norm(), q.rim.axis.cross(n).norm()) < flat;
    return {{0.5 * (p.at() + q.at()), -n, gap}, on_cap ? infinity : (d - gap * n).norm()};
}

Touch over_face(const Vec3& point, const PlacedSolid& other, int f)
{
    const Face& face = other.solid.faces[f];
    const Vec3 n = other.pose.R * face.normal;
    return {point, n, n.dot(point - other.pose.x) - face.offset};
}

// What a rod meets: another solid, or the creases and corners of a mesh.
struct Partner {
    PlacedSolid solid;
    const MeshTable* mesh = nullptr;
    Vec3 shift{0, 0, 0}; // of the mesh

    Vec3 corner(int k) const
    {
        return mesh ? Vec3(mesh->corners[k].point + shift)
                    : Vec3(solid.pose.x + solid.pose.R * solid.solid.corners[k]);
    }
    Line line(const Feature& feature) const
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
    case FeatureKind::cap_line:
        return line_over_cap(rim_of(rod, feature.i), feature.i == 0 ? -1 : 1, other.line(feature),
                             feature.j == 0 ? -1 : 1);
    case FeatureKind::cap_cap:
        return cap_on_cap(rim_of(rod, feature.i), feature.i == 0 ? -1 : 1,
                          rim_of(other.solid, feature.k), feature.j == 0 ? -1 : 1);
    case FeatureKind::rod_corner:
        return corner_touch(rod, other.corner(feature.k));
    case FeatureKind::side_line:
        return side_on_line(side_of(rod), other.line(feature));
    case FeatureKind::rim_line:
        return rim_on_line(rim_of(rod, feature.i), other.line(feature));
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
