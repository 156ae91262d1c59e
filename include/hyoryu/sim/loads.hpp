// SPDX-License-Identifier: MIT
// The forces of the fluid on bodies and walls in a step. Each process sums the forces on its own
// particles. From the pair forces on, all sums are exact, so that they do not depend on the order
// of their terms.
#pragma once

#include "hyoryu/core/owner_sums.hpp"
#include "hyoryu/ranks/reduction.hpp"
#include "hyoryu/rigid/rigid.hpp"
#include "hyoryu/sim/junctions.hpp"

#include <vector>

namespace hyoryu {

struct Simulation;

struct Loads {
    std::vector<Wrench> bodies; // of the last step for which the loads are complete
    std::vector<Vec3> walls;    // the same, on the particles of each wall [N]
    /// What each has besides, see junctions.hpp; empty without gauges of forces on walls [N].
    std::vector<Vec3> at_junctions;
    bool complete = true; // whether they are those of this step, if one has begun

    Junctions junctions;

    // The sums of this step.
    OwnerSums<6> of_bodies;    // force [N] and torque [N m]
    OwnerSums<3> of_walls;     // force [N]
    OwnerSums<3> of_junctions; // what walls have of the forces on particles of others [N]
    OwnerSums<7> of_hits; // of bodies: force, torque, and how far they yield, see wall_barrier.hpp
};

/// Begins the sums of a step with the forces between particles.
void begin_loads(Simulation& sim);

/// Ends the sums of this process, to which `all` is to add those of the others.
void end_loads(Loads& loads, Reduction& all);

/// Completes the loads, once the sums are those of all processes: with the recoil of bodies from
/// the particles that they stop, and with joints.
void complete_loads(Simulation& sim);

/// Ends the sums, adds those of all processes, and completes the loads.
void total_loads(Simulation& sim);

} // namespace hyoryu
