// SPDX-License-Identifier: MIT
// Prescribed motion of a wall: a constant velocity, or a path through points in time.
#pragma once

#include "hyoryu/core/types.hpp"

#include <vector>

namespace hyoryu {

/// How a wall is displaced from where it stands at time 0. With `times` the path runs through
/// `places` and `velocity` is not used; before the first and after the last time it rests.
struct Motion {
    Vec3 velocity{0, 0, 0};    // constant [m/s]
    std::vector<double> times; // ascending [s]
    std::vector<Vec3> places;  // displacement at each time [m]
};

/// Displacement at time t [m]. Between the points of a path each component is a monotone cubic
/// (Fritsch and Carlson 1980): it passes through the points, does not overshoot, and its velocity
/// has no jumps.
Vec3 displacement(const Motion& motion, double t);

/// The derivative of the displacement [m/s].
Vec3 velocity(const Motion& motion, double t);

/// Whether it ever moves.
bool moves(const Motion& motion);

/// A speed that the motion does not exceed between two times [m/s].
double speed_bound(const Motion& motion, double from, double to);

} // namespace hyoryu
