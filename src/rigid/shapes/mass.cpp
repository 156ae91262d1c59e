// SPDX-License-Identifier: MIT
// Exact mass properties of the contact shapes.
#include "hyoryu/rigid/body.hpp"
#include "solid.hpp"

#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

using std::numbers::pi;

// Sums of mass, first and second moments over simplices.
struct Moments {
    double mass = 0;
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();

    // The same of a solid whose origin was at d: integral of (x + d)(x + d)^T.
    Moments moved(const Vec3& d) const
    {
        const Mat3 mixed = first * d.transpose();
        return {mass, first + mass * d,
                second + mixed + mixed.transpose() + mass * d * d.transpose()};
    }

    // I = tr(J) E - J of the second moments J = integral of x x^T.
    MassProperties about_centre() const
    {
        const Vec3 centre = first / mass;
        const Mat3 J = second - mass * centre * centre.transpose();
        return {mass, J.trace() * Mat3::Identity() - J};
    }
};

// A tetrahedron with one corner at the origin: with s = a + b + c,
// integral of x x^T = V/20 (a a^T + b b^T + c c^T + s s^T).
void add_tetrahedron(Moments& sums, const Vec3& a, const Vec3& b, const Vec3& c, double density)
{
    const double mass = density * std::abs(a.dot(b.cross(c))) / 6;
    const Vec3 s = a + b + c;
    sums.mass += mass;
    sums.first += mass / 4 * s;
    sums.second +=
        mass / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
}

// A triangle with one corner at the origin: integral of x x^T = A/12 (a a^T + b b^T + s s^T).
void add_triangle(Moments& sums, const Vec3& a, const Vec3& b, double density)
{
    const double mass = density * a.cross(b).norm() / 2;
    const Vec3 s = a + b;
    sums.mass += mass;
    sums.first += mass / 3 * s;
    sums.second += mass / 12 * (a * a.transpose() + b * b.transpose() + s * s.transpose());
}

MassProperties of(const Ball& ball, double density, int dimensions)
{
    const double r2 = sq(ball.radius);
    if (dimensions == 2) {
        const double mass = density * pi * r2;
        return {mass, Vec3(mass * r2 / 4, mass * r2 / 2, mass * r2 / 4).asDiagonal()};
    }
    const double mass = density * 4 / 3 * pi * r2 * ball.radius;
    return {mass, 0.4 * mass * r2 * Mat3::Identity()};
}

MassProperties of(const Rod& rod, double density, int dimensions)
{
    const double r2 = sq(rod.radius);
    const double l2 = sq(rod.length);
    if (dimensions == 2) {
        const double mass = density * rod.length * 2 * rod.radius;
        return {mass, mass / 12 * Vec3(4 * r2, 4 * r2 + l2, l2).asDiagonal().toDenseMatrix()};
    }
    const double mass = density * pi * r2 * rod.length;
    const double across = mass * (3 * r2 + l2) / 12;
    return {mass, Vec3(mass * r2 / 2, across, across).asDiagonal()};
}

Vec3 middle(const Polytope& polytope)
{
    Vec3 sum = Vec3::Zero();
    for (const Vec3& corner : polytope.corners) {
        sum += corner / static_cast<double>(polytope.corners.size());
    }
    return sum;
}

// Simplices from a point inside to every face, about that point: exact, and blind to the
// orientation of the faces.
Moments moments_about(const Vec3& inside, const Polytope& polytope, double density, int dimensions)
{
    const auto& c = polytope.corners;
    Moments sums;
    if (dimensions == 2) {
        for (const auto& edge : faces_of(polytope, dimensions)) {
            add_triangle(sums, c[edge[0]] - inside, c[edge[1]] - inside, density);
        }
        return sums;
    }
    for (const auto& face : polytope.faces) {
        for (std::size_t k = 1; k + 1 < face.size(); ++k) {
            add_tetrahedron(sums, c[face[0]] - inside, c[face[k]] - inside, c[face[k + 1]] - inside,
                            density);
        }
    }
    return sums;
}

MassProperties of(const Polytope& polytope, double density, int dimensions)
{
    return moments_about(middle(polytope), polytope, density, dimensions).about_centre();
}

// The parts about the common centre (Steiner).
MassProperties of(const Compound& compound, double density, int dimensions)
{
    Moments sums;
    for (const Polytope& part : compound.parts) {
        const Vec3 inside = middle(part);
        const Moments own = moments_about(inside, part, density, dimensions).moved(inside);
        sums.mass += own.mass;
        sums.first += own.first;
        sums.second += own.second;
    }
    return sums.about_centre();
}

} // namespace

Polytope box_polytope(const Vec3& size, int dimensions)
{
    const Vec3 h = 0.5 * size;
    if (dimensions == 2) {
        return {{{-h.x(), 0, -h.z()}, {h.x(), 0, -h.z()}, {h.x(), 0, h.z()}, {-h.x(), 0, h.z()}},
                {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
    }
    Polytope box;
    for (int k = 0; k < 8; ++k) { // bits of k: the signs of x, y, z
        box.corners.emplace_back((k & 1) != 0 ? h.x() : -h.x(), (k & 2) != 0 ? h.y() : -h.y(),
                                 (k & 4) != 0 ? h.z() : -h.z());
    }
    box.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                 {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    return box;
}

MassProperties mass_properties(const ContactShape& shape, double density, int dimensions)
{
    return std::visit([&](const auto& form) { return of(form, density, dimensions); }, shape);
}

} // namespace hyoryu
