// SPDX-License-Identifier: MIT
#include "rotor.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Below this angle per call the second-order splitting is exact to round-off (its error is about
// the cube of the angle).
constexpr double small_turn = 1e-5; // [rad]
// Steps of the midpoint rule for two free axes, a case without an exact splitting.
constexpr int midpoint_steps = 8;

// The inertia restricted to the free axes, inverted.
Mat3 restricted_inverse(Mat3 inertia, const std::array<bool, 3>& turns)
{
    for (int k = 0; k < 3; ++k) {
        if (!turns[k]) {
            inertia.row(k).setZero();
            inertia.col(k).setZero();
            inertia(k, k) = 1;
        }
    }
    Mat3 inverse = inertia.inverse();
    for (int k = 0; k < 3; ++k) {
        if (!turns[k]) {
            inverse(k, k) = 0;
        }
    }
    return inverse;
}

// Rotation by `angle` about principal axis k of q, with the body-frame momentum l carried along.
void turn_about(Quat& q, Vec3& l, int k, double angle)
{
    const double half = angle / 2;
    const bool small = std::abs(half) < small_turn; // the series to round-off
    const double c2 = small ? 1 - 0.5 * half * half : std::cos(half);
    const double s2 = small ? half * (1 - half * half / 6) : std::sin(half);
    Vec3 axis = Vec3::Zero();
    axis[k] = s2;
    q = q * Quat(c2, axis.x(), axis.y(), axis.z());
    const double c = c2 * c2 - s2 * s2;
    const double s = 2 * c2 * s2;
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    const double li = l[i];
    l[i] = c * li + s * l[j]; // the frame turns by +angle, so l seen from it turns by -angle
    l[j] = c * l[j] - s * li;
}

// H = |l|^2 / 2 I2 + d1 l1^2 / 2 + d3 l3^2 / 2 with d = 1/I - 1/I2: Strang splitting of the last
// two; the first commutes with everything and is applied by the caller.
void strang(Quat& q, Vec3& l, double d1, double d3, double s)
{
    turn_about(q, l, 0, 0.5 * s * d1 * l[0]);
    turn_about(q, l, 2, s * d3 * l[2]);
    turn_about(q, l, 0, 0.5 * s * d1 * l[0]);
}

Quat turned_freely(const Rotor& rotor, const Quat& q, const Vec3& L, double s)
{
    const Vec3& w = rotor.inverse_moments;
    const double d1 = w[0] - w[1];
    const double d3 = w[2] - w[1];
    Quat p = q * rotor.principal;
    Vec3 l = p.conjugate() * L;
    const double angle = s * L.norm() * w.maxCoeff();
    if (angle < small_turn) {
        strang(p, l, d1, d3, s);
    } else {
        static const double outer = 1 / (4 - std::cbrt(4.0)); // Suzuki (1990)
        for (const double part : {outer, outer, 1 - 4 * outer, outer, outer}) {
            strang(p, l, d1, d3, part * s);
        }
    }
    return (rotation_by(s * w[1] * L) * p * rotor.principal.conjugate()).normalized();
}

} // namespace

Quat rotation_by(const Vec3& w)
{
    const double half = 0.5 * w.norm();
    // sin(x)/x to round-off near zero
    const double sinc = half < 1e-4 ? 1 - half * half / 6 : std::sin(half) / half;
    const Vec3 v = 0.5 * sinc * w;
    return {std::cos(half), v.x(), v.y(), v.z()};
}

Rotor rotor_of(const Body& body, int dimensions)
{
    Rotor rotor;
    const bool planar = dimensions == 2;
    const std::array<bool, 6> plane{false, true, false, true, false, true};
    for (int k = 0; k < 3; ++k) {
        const bool moves = !body.left && !body.locks[k] && !(planar && plane[k]);
        rotor.inverse_mass[k] = moves ? 1 / body.mass.mass : 0;
        rotor.turns[k] = !body.left && !body.locks[3 + k] && !(planar && plane[3 + k]);
    }
    rotor.free_axes = static_cast<int>(std::count(rotor.turns.begin(), rotor.turns.end(), true));
    rotor.movable = rotor.free_axes > 0 || (rotor.inverse_mass.array() > 0).any();
    rotor.inertia = body.mass.inertia;
    rotor.inverse_inertia = body.mass.inertia.inverse();
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(body.mass.inertia); // ascending: middle second
    Mat3 frame = axes.eigenvectors();
    if (frame.determinant() < 0) {
        frame.col(0) = -frame.col(0);
    }
    rotor.principal = Quat(frame).normalized();
    rotor.inverse_moments = axes.eigenvalues().cwiseInverse();
    const double spread = axes.eigenvalues()[2] - axes.eigenvalues()[0];
    rotor.spherical = spread < 1e-14 * axes.eigenvalues()[2]; // equal to round-off
    return rotor;
}

Mat3 inverse_inertia(const Rotor& rotor, const Mat3& R)
{
    if (rotor.free_axes == 0) {
        return Mat3::Zero();
    }
    if (rotor.spherical && rotor.free_axes == 3) {
        return rotor.inverse_inertia;
    }
    if (rotor.free_axes == 3) {
        return R * rotor.inverse_inertia * R.transpose();
    }
    return restricted_inverse(R * rotor.inertia * R.transpose(), rotor.turns);
}

Quat turned(const Rotor& rotor, const Quat& q, const Vec3& L, double s)
{
    if (rotor.free_axes == 0) {
        return q;
    }
    if (rotor.free_axes == 3) {
        return rotor.spherical ? (rotation_by(s * rotor.inverse_moments[1] * L) * q).normalized()
                               : turned_freely(rotor, q, L, s);
    }
    if (rotor.free_axes == 1) { // the moment about a fixed axis is constant
        const Vec3 omega = inverse_inertia(rotor, q.toRotationMatrix()) * L;
        return (rotation_by(s * omega) * q).normalized();
    }
    Quat p = q;
    const double part = s / midpoint_steps;
    for (int k = 0; k < midpoint_steps; ++k) {
        const Vec3 w0 = inverse_inertia(rotor, p.toRotationMatrix()) * L;
        const Quat mid = rotation_by(0.5 * part * w0) * p;
        const Vec3 w1 = inverse_inertia(rotor, mid.toRotationMatrix()) * L;
        p = (rotation_by(part * w1) * p).normalized();
    }
    return p;
}

} // namespace hyoryu
