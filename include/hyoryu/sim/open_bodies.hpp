// SPDX-License-Identifier: MIT
// Bodies that leave the run through open sides.
#pragma once

#include "hyoryu/core/types.hpp"

namespace hyoryu {

struct Simulation;

/// A body that has left, and the state in which it did.
struct LeftBody {
    int body = 0;           // its number in the scene
    int side = 0;           // the number of the open side
    double time = 0;        // at the start of the step [s]
    Vec3 position{0, 0, 0}; // of the centre of mass [m]
    Vec3 velocity{0, 0, 0}; // [m/s]
};

/// Removes the bodies that have passed a window at which bodies leave: all of the body must be
/// behind it by more than the support of the kernel, so that the water inside is not affected.
/// Their particles, contacts and joints are removed; their momentum and energy are booked as
/// carried out. Call only before lists are made, since rows of body particles move.
void let_bodies_leave(Simulation& sim);

/// The same for those that a checkpoint lists, before its rows of particles are read.
void remove_left_bodies(Simulation& sim);

} // namespace hyoryu
