// SPDX-License-Identifier: MIT
// Prescribed motion of a wall: a constant velocity, or a path through points in time.
#pragma once

#include "hyoryu/core/types.hpp"

#include <optional>
#include <vector>

namespace hyoryu {

/// How a wall is displaced from where it stands at time 0. With `times` the path runs through
/// `places` and `velocity` is not used; before the first and after the last time it rests.
struct Motion {
    Vec3 velocity{0, 0, 0};    // constant [m/s]
    std::vector<double> times; // ascending [s]
    std::vector<Vec3> places;  // displacement at each time [m]

    /// Motion of a wave-absorbing paddle in addition to its path, along x.
    struct Absorption {
        double depth = 0;           // of the water at rest [m]
        std::vector<double> levels; // asked for at the paddle, above still water, at `times` [m]
        // Of the current step, set by the simulation.
        double time = 0;     // from which it holds [s]
        double place = 0;    // displacement at that time [m]
        double velocity = 0; // [m/s]
    };
    std::optional<Absorption> absorption; // none: the path only
};

/// Displacement at time t [m]. Between the points of a path each component is a monotone cubic
/// (Fritsch and Carlson 1980): it passes through the points, does not overshoot, and its velocity
/// has no jumps.
Vec3 displacement(const Motion& motion, double t);

/// The derivative of the displacement [m/s].
Vec3 velocity(const Motion& motion, double t);

/// The level that the path of a paddle asks for at time t above still water, linear between its
/// times and 0 outside of them [m].
double asked_level(const Motion& motion, double t);

/// Whether the wall moves at any time.
bool moves(const Motion& motion);

/// A speed that the motion does not exceed between two times [m/s].
double speed_bound(const Motion& motion, double from, double to);

} // namespace hyoryu
