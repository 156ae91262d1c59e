// SPDX-License-Identifier: MIT
// Finds the particles of a body that are near those of a wall or of another body.
#pragma once

#include "rigid/motion/memory.hpp"

namespace hyoryu {

/// Two particles that may push each other.
struct ParticlePair {
    Vec3 a{0, 0, 0}; // in the axes of body a [m]
    Vec3 b{0, 0, 0}; // in the axes of body b, or where it is at time 0 on a boundary [m]
};

/// The particle pairs of two bodies, or of a body and a boundary.
struct Meeting {
    BodyPair who;
    double range = 0; // distance at which their particles touch [m]
    std::vector<ParticlePair> pairs;
};

/// All pairs of particles nearer than their range and `skin` at the poses of the memory, in an
/// order that follows from the poses alone.
std::vector<Meeting> find_meetings(const StepContext& context, double skin, double time);

} // namespace hyoryu
