// SPDX-License-Identifier: MIT
// Coupling of fluid and bodies, the only layer that uses both. The pose of a body gives the
// positions and velocities of its particles; the pair forces on these are summed to the load of the
// body. Joints under standing bodies, which are too narrow for particles, add a pressure of their
// own (seepage).
#pragma once

#include "hyoryu/core/owner_sums.hpp"
#include "hyoryu/fluid/fluid.hpp"
#include "hyoryu/rigid/rigid.hpp"

#include <vector>

namespace hyoryu {

/// The particles of all bodies in body axes, body after body, in the order of their rows.
struct BodyParticles {
    std::vector<Vec3> points; // about the centre of mass [m]
    std::vector<Rows> of;     // of each body, counted from the first body row
};

/// Position and orientation.
struct Pose {
    Vec3 position{0, 0, 0}; // [m]
    Quat orientation = Quat::Identity();
};

/// Where each body is after moving freely for `ahead` [s].
std::vector<Pose> free_flight(const Rigid& rigid, double ahead);

/// Places the particles of every body at its pose, with the velocity V + omega x r.
void place_bodies(const Rigid& rigid, const std::vector<Pose>& poses, const BodyParticles& bodies,
                  Fluid& fluid);

/// Begins the sums of force [N] and torque [N m] (about the centre of mass of the pose) on each
/// body with the forces on its particles, which are equal and opposite to those on the fluid. A sum
/// is not-a-number where a force is not finite or beyond all scales of the fluid (`FixedSum`).
void collect_loads(const Fluid& fluid, const std::vector<Pose>& poses, OwnerSums<6>& sums);

/// Begins the sums of the force [N] on each of the `walls` walls of the scene with the forces on
/// their particles.
void collect_wall_forces(const Fluid& fluid, std::size_t walls, OwnerSums<3>& sums);

} // namespace hyoryu
