// SPDX-License-Identifier: MIT
#include "row.hpp"

#include <Eigen/Eigenvalues>

namespace hyoryu {

namespace {

// A tangent whose inverse mass is below this part of the normal one is locked.
constexpr double locked_part = 1e-12;

// Tangents that change smoothly with the normal: both configurations use the same helper axis.
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

// Moments of unit forces along the axes about the centre of mass: the normal force acts at the
// contact point, the tangential forces at the friction point.
Mat3 moments(const Vec3& arm, const Vec3& friction_offset, const Mat3& axes)
{
    Mat3 result;
    result.col(0) = arm.cross(axes.col(0));
    result.col(1) = (arm + friction_offset).cross(axes.col(1));
    result.col(2) = (arm + friction_offset).cross(axes.col(2));
    return result;
}

// Contribution of one body to K: change of the contact velocity under unit impulses along the axes.
Mat3 inverse_mass(const Row& row, const Response& body, const Mat3& turn, const Mat3& lever)
{
    return row.D.transpose() * body.inverse_mass.asDiagonal() * row.B +
           lever.transpose() * (body.inverse_inertia * turn);
}

void set_answer(Row& row, const std::vector<Response>& bodies)
{
    row.cone.K = inverse_mass(row, bodies[row.a], row.turn_a, row.lever_a);
    if (row.b >= 0) {
        row.cone.K += inverse_mass(row, bodies[row.b], row.turn_b, row.lever_b);
    }
}

void fill(Row& row, const TwoTouches& at, const Centres& c, const std::vector<Response>& bodies)
{
    row.turn_a = moments(at.push.point - c.push_a, at.push_friction_offset, row.B);
    row.lever_a = moments(at.see.point - c.see_a, at.see_friction_offset, row.D);
    if (row.b >= 0) {
        row.turn_b = moments(at.push.point - c.push_b, at.push_friction_offset, row.B);
        row.lever_b = moments(at.see.point - c.see_b, at.see_friction_offset, row.D);
    }
    set_answer(row, bodies);
}

// Rotates the tangents to the principal axes of the tangential block; returns the number of
// tangents that are not locked.
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

void see_mean_slip(Row& row, const Twist& a, const Twist& b, const Vec3& wall,
                   const std::vector<Response>& bodies)
{
    row.D.rightCols<2>() = row.B.rightCols<2>();
    row.lever_a.rightCols<2>() = row.turn_a.rightCols<2>();
    row.lever_b.rightCols<2>() = row.turn_b.rightCols<2>();
    set_answer(row, bodies);
    invert(row.cone);
    row.slip = row.D.transpose() * (a.v - b.v - wall) + row.lever_a.transpose() * a.omega -
               row.lever_b.transpose() * b.omega;
    row.slip[0] = 0;
}

Vec3 velocity(const Row& row, const std::vector<Response>& bodies)
{
    const Response& a = bodies[row.a];
    Vec3 v = a.v - row.wall_velocity;
    Vec3 u = row.lever_a.transpose() * a.omega;
    if (row.b >= 0) {
        const Response& b = bodies[row.b];
        v -= b.v;
        u -= row.lever_b.transpose() * b.omega;
    }
    return u + row.D.transpose() * v + row.slip;
}

void push(Row& row, const Vec3& dp, std::vector<Response>& bodies)
{
    row.p += dp;
    const Vec3 P = row.B * dp;
    // Immovable bodies are shared by islands that are solved in parallel; they are never written.
    Response& a = bodies[row.a];
    if (a.movable) {
        a.v += a.inverse_mass.cwiseProduct(P);
        a.omega += a.inverse_inertia * (row.turn_a * dp);
    }
    if (row.b >= 0 && bodies[row.b].movable) {
        Response& b = bodies[row.b];
        b.v -= b.inverse_mass.cwiseProduct(P);
        b.omega -= b.inverse_inertia * (row.turn_b * dp);
    }
}

void set_impulses(std::span<Row> rows, const std::vector<Vec3>& p, std::vector<Response>& bodies)
{
    for (std::size_t k = 0; k < rows.size(); ++k) {
        push(rows[k], p[k] - rows[k].p, bodies);
    }
}

} // namespace hyoryu
