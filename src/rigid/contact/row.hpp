// SPDX-License-Identifier: MIT
// One contact of the contact problem: its Jacobian rows and the response of the bodies to its
// impulse.
#pragma once

#include "cone.hpp"
#include "rigid/collision/feature.hpp"

#include <span>
#include <vector>

namespace hyoryu {

/// The velocities of a body during a solve.
struct Response {
    bool movable = true;
    Vec3 inverse_mass{0, 0, 0}; // of each world axis [1/kg]
    Mat3 inverse_inertia = Mat3::Zero();
    Vec3 v{0, 0, 0};
    Vec3 omega{0, 0, 0};
};

/// Velocity of the centre of mass and spin of a body.
struct Twist {
    Vec3 v{0, 0, 0};     // [m/s]
    Vec3 omega{0, 0, 0}; // [rad/s]
};

/// A contact at two configurations: the impulse acts at `push`, the velocity is constrained at
/// `see`. In an impact they are the same; in a smooth step they are its middle and its end.
/// Friction may act at another point of the tangent plane.
struct TwoTouches {
    Touch push;
    Touch see;
    Vec3 push_friction_offset{0, 0, 0},
        see_friction_offset{0, 0, 0}; // from contact point to friction point [m]
};

/// Rows of the contact problem: u = D^T (v_a - v_b - w) + S_a^T omega_a - S_b^T omega_b, and the
/// impulse p changes v by B p / M and omega by I^-1 T p. Columns of T and S are r x B and s x D
/// with the arms r and s of the normal and of friction.
struct Row {
    int a = 0, b = -1; // bodies; b < 0 is a boundary
    int contact = 0;   // index of the contact in the caller's list
    Cone cone;
    Mat3 B = Mat3::Identity();                           // n, t1, t2 where the impulse acts
    Mat3 D = Mat3::Identity();                           // the same where velocity is constrained
    Mat3 turn_a = Mat3::Zero(), turn_b = Mat3::Zero();   // T, moments of unit impulses [m]
    Mat3 lever_a = Mat3::Zero(), lever_b = Mat3::Zero(); // S, velocities of unit spins [m]
    Vec3 wall_velocity{0, 0, 0};
    Vec3 slip{0, 0, 0};   // added to the contact velocity, in the axes of D [m/s]
    double target = 0;    // target normal velocity [m/s]
    Vec3 before{0, 0, 0}; // velocity at the start of the solve, in the axes of D [m/s]
    Vec3 p{0, 0, 0};      // impulse in the axes of B [N s]
    bool tangential = false;

    Vec3 impulse() const { return B * p; }
};

/// Positions of the two centres of mass at the two configurations.
struct Centres {
    Vec3 push_a{0, 0, 0}, push_b{0, 0, 0}, see_a{0, 0, 0}, see_b{0, 0, 0};
};

/// Completes a row whose a, b, wall_velocity and cone.mu are set.
void complete(Row& row, const TwoTouches& at, const Centres& centres,
              const std::vector<Response>& bodies, int dimensions);

/// Midpoint rule: makes friction oppose the mean of the slips before the solve (from the given
/// velocities) and after it. The tangential velocity of the row becomes the sum of the two slips.
void see_mean_slip(Row& row, const Twist& a, const Twist& b, const Vec3& wall,
                   const std::vector<Response>& bodies);

/// The velocity of the contact in the axes (n, t1, t2).
Vec3 velocity(const Row& row, const std::vector<Response>& bodies);

/// Adds dp to the impulse of the row and to the bodies.
void push(Row& row, const Vec3& dp, std::vector<Response>& bodies);

/// Sets the impulses of the rows and updates the velocities of the bodies.
void set_impulses(std::span<Row> rows, const std::vector<Vec3>& p, std::vector<Response>& bodies);

} // namespace hyoryu
