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
// Newton steps and halvings of one of them; a handful is the rule.
constexpr int most_steps = 40;
constexpr int most_halvings = 20;
// Two rims whose tangents at the contact are this near to parallel (sine squared) meet in no point.
constexpr double tangent_rims = 1e-12;
// Round-off, as a part of the lengths or of the unit normal.
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

Line side_of(const Placed& rod)
{
    const Vec3 axis = rod.pose.R.col(0);
    const double half = rod.solid.half_length;
    return {rod.pose.x - half * axis, axis, 2 * half, rod.solid.radius};
}

Rim rim_of(const Placed& rod, int i)
{
    const Vec3 axis = rod.pose.R.col(0);
    return {rod.pose.x + (i == 0 ? -1 : 1) * rod.solid.half_length * axis, axis, rod.solid.radius};
}

Line line_between(const Vec3& p, const Vec3& q)
{
    const double length = (q - p).norm();
    return {p, (q - p) / length, length, 0};
}

RodTouch side_on_line(const Line& side, const Line& line)
{
    const Vec3 cross = side.along.cross(line.along);
    const double sine = cross.norm();
    const Vec3 r = side.from - line.from;
    if (sine <= no_direction) {
        const Vec3 away = r - line.along * line.along.dot(r);
        const Vec3 n = away.normalized();
        return {{line.from + line.radius * n, n, away.norm() - side.radius - line.radius},
                infinity};
    }
    const Vec3 n = (cross.dot(r) < 0 ? -1 : 1) / sine * cross;
    const double gap = n.dot(r) - side.radius - line.radius;
    const double s = line.along.cross(r).dot(cross) / sq(sine);
    const double t = side.along.cross(r).dot(cross) / sq(sine);
    const Vec3 point =
        line.from + std::clamp(t, 0.0, line.length) * line.along + (line.radius + 0.5 * gap) * n;
    return {{point, n, gap}, std::max(side.past(s), line.past(t))};
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
    const double gap = out.dot(r) - rim.radius * rim.axis.cross(out).norm() - line.radius;
    const Vec3 on_rim = rim.centre + rim.towards(out);
    const double past = line.past(line.along.dot(on_rim - line.from));
    return {{on_rim + 0.5 * gap * out, -out, gap}, past};
}

// The direction from rim a to rim b along which they are farthest apart, by Newton's method on the
// unit sphere from a guess: the gap falls off with r/|n x u| across each tangent n x u.
Vec3 farthest_apart(const Rim& a, const Rim& b, Vec3 n)
{
    const Vec3 d = b.centre - a.centre;
    const auto gap = [&](const Vec3& m) {
        return m.dot(d) - a.radius * a.axis.cross(m).norm() - b.radius * b.axis.cross(m).norm();
    };
    for (int k = 0; k < most_steps; ++k) {
        Eigen::Matrix<double, 3, 2> plane;
        plane.col(0) = any_square_to(n);
        plane.col(1) = n.cross(plane.col(0));
        const Vec3 apart = d - a.towards(n) - b.towards(n); // of the two nearest points
        const Eigen::Vector2d slope = plane.transpose() * apart;
        Eigen::Matrix2d bend = Eigen::Matrix2d::Zero();
        for (const Rim& rim : {a, b}) {
            const Vec3 across = rim.axis.cross(n);
            const double sine = std::max(across.norm(), no_direction);
            const Eigen::Vector2d w = plane.transpose() * across;
            bend += rim.radius / (sine * sq(sine)) * (w * w.transpose());
        }
        const double size = bend.trace();
        const Eigen::Matrix2d falling = bend + apart.dot(n) * Eigen::Matrix2d::Identity();
        if (falling.determinant() > tangent_rims * sq(size)) {
            bend = falling;
        } else {
            bend += 1e-3 * size * Eigen::Matrix2d::Identity();
        }
        const Vec3 step = plane * (bend.inverse() * slope);
        const double enough = gap(n) - round_off * d.norm();
        double part = 1;
        Vec3 next = (n + step).normalized();
        for (int h = 0; h < most_halvings && gap(next) < enough; ++h) {
            part *= 0.5;
            next = (n + part * step).normalized();
        }
        n = next;
        if (step.norm() <= round_off) {
            break;
        }
    }
    return n;
}

RodTouch rim_on_rim(const Rim& a, const Rim& b)
{
    const auto axis = [](const Rim& rim) { return Line{rim.centre, rim.axis, 0, rim.radius}; };
    // from a to b past the side of either
    const Vec3 guess = rim_on_line(b, axis(a)).touch.normal - rim_on_line(a, axis(b)).touch.normal;
    const double length = guess.norm();
    const Vec3 n =
        farthest_apart(a, b, length > no_direction ? Vec3(guess / length) : any_square_to(a.axis));
    const Vec3 p = a.centre + a.towards(n);
    const Vec3 q = b.centre - b.towards(n);
    const double gap = n.dot(q - p);
    return {{0.5 * (p + q), -n, gap}, (q - p - gap * n).norm()};
}

Touch over_face(const Vec3& point, const Placed& other, int f)
{
    const Face& face = other.solid.faces[f];
    const Vec3 n = other.pose.R * face.normal;
    return {point, n, n.dot(point - other.pose.x) - face.offset};
}

Touch side_over_cap(const Feature& feature, const Placed& rod, const Placed& other)
{
    const Vec3 n = other.pose.R * other.solid.faces[feature.f].normal;
    const auto corner = [&](int k) {
        return Vec3(other.pose.x + other.pose.R * other.solid.corners[k]);
    };
    const Vec3 p = crossing_point(low_point(rod, 0, n), low_point(rod, 1, n), corner(feature.k),
                                  corner(feature.l), n);
    return over_face(p, other, feature.f);
}

// What a rod meets: another solid, or the creases and corners of a mesh.
struct Partner {
    Placed solid;
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
    const Wall& wall = at.geometry.walls[-1 - index];
    return {placed(at, index), &wall.mesh, displacement(wall.motion, at.time)};
}

RodTouch corner_touch(const Placed& rod, const Vec3& corner)
{
    const Touch local = nearest(rod.solid, rod.pose.R.transpose() * (corner - rod.pose.x));
    return {{corner, -(rod.pose.R * local.normal), local.gap}};
}

RodTouch touch_on_rod(const Feature& feature, const Placed& rod, const Partner& other)
{
    switch (feature.kind) {
    case FeatureKind::rim_face: {
        const Vec3 n = other.solid.pose.R * other.solid.solid.faces[feature.f].normal;
        return {over_face(low_point(rod, feature.i, n), other.solid, feature.f)};
    }
    case FeatureKind::side_cap:
        return {side_over_cap(feature, rod, other.solid)};
    case FeatureKind::rod_corner:
        return corner_touch(rod, other.corner(feature.k));
    case FeatureKind::side_line:
        return side_on_line(side_of(rod), other.line(feature));
    case FeatureKind::rim_line:
        return rim_on_line(rim_of(rod, feature.i), other.line(feature));
    default:
        return rim_on_rim(rim_of(rod, feature.i), rim_of(other.solid, feature.j));
    }
}

} // namespace

Vec3 low_point(const Placed& rod, int i, const Vec3& n)
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
    const Placed rod = placed(at, owner_is_a ? feature.a : feature.b);
    RodTouch found = touch_on_rod(feature, rod, partner(at, owner_is_a ? feature.b : feature.a));
    if (!owner_is_a) {
        found.touch.normal = -found.touch.normal;
    }
    return found;
}

} // namespace hyoryu
