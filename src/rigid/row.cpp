// SPDX-License-Identifier: MIT
#include "row.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace hyoryu {

namespace {

// A tangent in which the inverse mass is below this part of the normal one belongs to locked axes.
constexpr double locked_part = 1e-12;

// Tangents that change smoothly with the normal: both configurations use the same helping axis.
Mat3 axes(const Vec3& n, int helper, int dimensions)
{
    Mat3 basis;
    basis.col(0) = n;
    if (dimensions == 2) {
        basis.col(1) = Vec3(n.z(), 0, -n.x());
        basis.col(2) = Vec3::Zero();
    } else {
        basis.col(1) = n.cross(Vec3::Unit(helper)).normalized();
        basis.col(2) = n.cross(Vec3(basis.col(1)));
    }
    return basis;
}

// What the impulse of one body's side changes at the contact, for unit impulses along the axes.
Mat3 inverse_mass(const Row& row, const Response& body, const Vec3& arm, const Vec3& seen)
{
    Mat3 K;
    for (int m = 0; m < 3; ++m) {
        const Vec3 P = row.B.col(m);
        K.col(m) = row.D.transpose() * (body.inverse_mass.cwiseProduct(P) +
                                        (body.inverse_inertia * arm.cross(P)).cross(seen));
    }
    return K;
}

void fill(Row& row, const TwoTouches& at, const Centres& c, const std::vector<Response>& bodies)
{
    row.arm_a = at.push.point - c.push_a;
    row.seen_a = at.see.point - c.see_a;
    row.cone.K = inverse_mass(row, bodies[row.a], row.arm_a, row.seen_a);
    if (row.b >= 0) {
        row.arm_b = at.push.point - c.push_b;
        row.seen_b = at.see.point - c.see_b;
        row.cone.K += inverse_mass(row, bodies[row.b], row.arm_b, row.seen_b);
    }
}

// Turns the tangents into the axes of the tangential block; returns how many of them can move.
int movable_tangents(Row& row)
{
    const Eigen::Matrix2d block = row.cone.K.block<2, 2>(1, 1);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> modes(0.5 * (block + block.transpose()));
    const double least = locked_part * row.cone.K(0, 0);
    if (modes.eigenvalues()[0] > least) {
        return 2;
    }
    Eigen::Matrix2d order;
    order << modes.eigenvectors().col(1), modes.eigenvectors().col(0);
    row.B.rightCols<2>() = (row.B.rightCols<2>() * order).eval();
    row.D.rightCols<2>() = (row.D.rightCols<2>() * order).eval();
    return modes.eigenvalues()[1] > least ? 1 : 0;
}

} // namespace

void complete(Row& row, const TwoTouches& at, const Centres& centres,
              const std::vector<Response>& bodies, int dimensions)
{
    int helper = 0;
    at.push.normal.cwiseAbs().minCoeff(&helper);
    row.B = axes(at.push.normal, helper, dimensions);
    row.D = axes(at.see.normal, helper, dimensions);
    fill(row, at, centres, bodies);
    const int tangents = dimensions - 1;
    row.cone.size = row.cone.mu > 0 ? 1 + tangents : 1;
    const double least = locked_part * row.cone.K(0, 0);
    if (row.cone.size == 2 && row.cone.K(1, 1) <= least) {
        row.cone.size = 1;
    } else if (row.cone.size == 3 &&
               row.cone.K(1, 1) * row.cone.K(2, 2) - row.cone.K(1, 2) * row.cone.K(2, 1) <=
                   least * (row.cone.K(1, 1) + row.cone.K(2, 2))) {
        row.cone.size = 1 + movable_tangents(row);
        fill(row, at, centres, bodies);
    }
    invert(row.cone);
}

Vec3 velocity(const Row& row, const std::vector<Response>& bodies)
{
    const Response& a = bodies[row.a];
    Vec3 u = a.v + a.omega.cross(row.seen_a) - row.wall_velocity;
    if (row.b >= 0) {
        const Response& b = bodies[row.b];
        u -= b.v + b.omega.cross(row.seen_b);
    }
    return row.D.transpose() * u;
}

void push(Row& row, const Vec3& dp, std::vector<Response>& bodies)
{
    row.p += dp;
    const Vec3 P = row.B * dp;
    // Immovable bodies are shared between islands that are solved side by side: never written.
    Response& a = bodies[row.a];
    if (a.movable) {
        a.v += a.inverse_mass.cwiseProduct(P);
        a.omega += a.inverse_inertia * row.arm_a.cross(P);
    }
    if (row.b >= 0 && bodies[row.b].movable) {
        Response& b = bodies[row.b];
        b.v -= b.inverse_mass.cwiseProduct(P);
        b.omega -= b.inverse_inertia * row.arm_b.cross(P);
    }
}

void set_impulses(std::span<Row> rows, const std::vector<Vec3>& p, std::vector<Response>& bodies)
{
    for (std::size_t k = 0; k < rows.size(); ++k) {
        push(rows[k], p[k] - rows[k].p, bodies);
    }
}

} // namespace hyoryu
