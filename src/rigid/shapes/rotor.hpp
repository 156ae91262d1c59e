// SPDX-License-Identifier: MIT
// The free rotor: how a body turns under its angular momentum, and its inverse inertia under locks.
#pragma once

#include "hyoryu/rigid/body.hpp"

namespace hyoryu {

/// Precomputed constants of the rotation and translation of a body.
struct Rotor {
    Quat principal = Quat::Identity();       // principal axes to body axes
    Vec3 inverse_moments{1, 1, 1};           // 1/I of the principal axes, the middle one second
    Mat3 inverse_inertia = Mat3::Identity(); // I_b^-1
    Mat3 inertia = Mat3::Identity();         // I_b
    Vec3 inverse_mass{0, 0, 0};              // 1/M of each world axis, 0 where locked [1/kg]
    std::array<bool, 3> turns{};             // world axes free to rotate
    int free_axes = 3;
    bool spherical = false;
    bool movable = true; // not locked in every axis
};

Rotor rotor_of(const Body& body, int dimensions);

/// The inverse inertia in world axes. Locks are constraints: the inertia restricted to the free
/// axes is inverted, and rows and columns of the locked axes are zero.
Mat3 inverse_inertia(const Rotor& rotor, const Mat3& R);

/// The orientation after a time s of rotation with constant L. Three free axes: symmetric splitting
/// of the free rotor (Dullweber, Leimkuhler, McLachlan 1997) about the spherical rotor of the
/// middle moment, so that bodies of revolution are exact, composed to fourth order (Suzuki 1990).
Quat turned(const Rotor& rotor, const Quat& q, const Vec3& L, double s);

/// exp(w/2) as a unit quaternion: the rotation by the vector w [rad].
Quat rotation_by(const Vec3& w);

} // namespace hyoryu
