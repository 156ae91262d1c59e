// SPDX-License-Identifier: MIT
#include "mass.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace witness {

namespace {

// Volume, first and second moments about the origin, summed over the tetrahedra that the triangles
// span with it.
struct Moments {
    double volume = 0;
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero(); // integral of r r^T
};

Moments moments_of(const Mesh& mesh)
{
    Moments m;
    for (const auto& t : mesh.triangles) {
        const Vec3& a = mesh.corners[static_cast<std::size_t>(t[0])];
        const Vec3& b = mesh.corners[static_cast<std::size_t>(t[1])];
        const Vec3& c = mesh.corners[static_cast<std::size_t>(t[2])];
        const double volume = a.dot(b.cross(c)) / 6;
        const Vec3 sum = a + b + c;
        m.volume += volume;
        m.first += volume * sum / 4;
        // Of a tetrahedron with a corner in the origin: V/20 (sum of r r^T over corners + S S^T).
        m.second +=
            volume / 20 *
            (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
    }
    return m;
}

Mat3 inertia_from(const Mat3& second)
{
    return second.trace() * Mat3::Identity() - second;
}

MassProperties box_of(double density, const Vec3& size)
{
    const double mass = density * size.prod();
    const Vec3 square = mass / 12 * size.cwiseAbs2();
    return {mass, inertia_from(Mat3(square.asDiagonal()))};
}

MassProperties flat(const Solid& body)
{
    using std::numbers::pi;
    if (body.kind == Kind::ball) {
        const double mass = body.density * pi * body.radius * body.radius;
        return {mass, mass * body.radius * body.radius / 2 * Mat3::Identity()};
    }
    const bool rod = body.kind == Kind::cylinder;
    const double a = rod ? body.length : body.size.x();
    const double b = rod ? 2 * body.radius : body.size.z();
    const double mass = body.density * a * b;
    return {mass, mass * (a * a + b * b) / 12 * Mat3::Identity()};
}

MassProperties solid(const Solid& body)
{
    using std::numbers::pi;
    const double r = body.radius;
    switch (body.kind) {
    case Kind::ball: {
        const double mass = body.density * 4 / 3 * pi * r * r * r;
        return {mass, 0.4 * mass * r * r * Mat3::Identity()};
    }
    case Kind::cylinder: {
        const double mass = body.density * pi * r * r * body.length;
        const double across = mass * (3 * r * r + body.length * body.length) / 12;
        return {mass, Vec3(mass * r * r / 2, across, across).asDiagonal()};
    }
    case Kind::mesh: {
        const Moments m = moments_of(body.mesh); // about the centroid, where the corners stand
        return {body.density * m.volume, body.density * inertia_from(m.second)};
    }
    case Kind::cubes: {
        const double m = body.density * std::pow(body.edge, 3);
        MassProperties all;
        for (const Vec3& p : body.points) {
            all.mass += m;
            all.inertia += m * inertia_from(p * p.transpose()) +
                           m * body.edge * body.edge / 6 * Mat3::Identity();
        }
        return all;
    }
    default:
        return box_of(body.density, body.size);
    }
}

double distance_to_segment(const Vec3& a, const Vec3& b, const Vec3& p)
{
    const Vec3 d = b - a;
    const double t = std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
    return (p - a - t * d).norm();
}

double distance_to_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p)
{
    const Vec3 n = (b - a).cross(c - a);
    const bool above = n.cross(b - a).dot(p - a) >= 0 && n.cross(c - b).dot(p - b) >= 0 &&
                       n.cross(a - c).dot(p - c) >= 0;
    return above ? std::abs(n.dot(p - a)) / n.norm()
                 : std::min({distance_to_segment(a, b, p), distance_to_segment(b, c, p),
                             distance_to_segment(c, a, p)});
}

} // namespace

MassProperties mass_of(const Solid& body, int dimensions)
{
    if (body.inertia) {
        Solid uniform = body;
        uniform.inertia.reset();
        return {mass_of(uniform, dimensions).mass, body.inertia->asDiagonal()};
    }
    if (!body.given) {
        return dimensions == 2 ? flat(body) : solid(body);
    }
    Solid light = body;
    light.given.reset();
    light.density = 1;
    MassProperties unit = mass_of(light, dimensions);
    return {*body.given, *body.given / unit.mass * unit.inertia};
}

Vec3 centroid(const Mesh& mesh)
{
    const Moments m = moments_of(mesh);
    return m.first / m.volume;
}

Eigen::AlignedBox3d bounds_of(const Mesh& mesh)
{
    Eigen::AlignedBox3d box;
    for (const Vec3& corner : mesh.corners) {
        box.extend(corner);
    }
    return box;
}

double winding_number(const Mesh& mesh, const Vec3& point)
{
    double angle = 0;
    for (const auto& t : mesh.triangles) {
        const Vec3 a = mesh.corners[static_cast<std::size_t>(t[0])] - point;
        const Vec3 b = mesh.corners[static_cast<std::size_t>(t[1])] - point;
        const Vec3 c = mesh.corners[static_cast<std::size_t>(t[2])] - point;
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        angle += 2 * std::atan2(a.dot(b.cross(c)),
                                la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return angle / (4 * std::numbers::pi);
}

double distance_to(const Mesh& mesh, const Vec3& point)
{
    double nearest = INFINITY;
    for (const auto& t : mesh.triangles) {
        nearest = std::min(
            nearest, distance_to_triangle(mesh.corners[static_cast<std::size_t>(t[0])],
                                          mesh.corners[static_cast<std::size_t>(t[1])],
                                          mesh.corners[static_cast<std::size_t>(t[2])], point));
    }
    return nearest;
}

} // namespace witness
