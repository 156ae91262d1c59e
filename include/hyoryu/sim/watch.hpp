// SPDX-License-Identifier: MIT
// Detection of instability: checks of the state after each step.
#pragma once

#include "hyoryu/sim/conservation.hpp"

#include <vector>

namespace hyoryu {

struct Simulation;

/// Keeps the largest compression of the fluid, as `now` has it, and throws NumericalError that
/// names the particle or body, its surroundings and the probable cause when the state is not
/// finite, a density or speed is beyond what a weakly compressible flow can have, a moving wall
/// crushes a body against a fixed solid, or solids overlap by more than the inner radius of the
/// thinnest body.
void watch(Simulation& sim, const StateSurvey& now);

/// Throws NumericalError when a run without energy input (no moving wall, no acceleration, impulses
/// with the coupled law) has gained more than half of its energy of motion and compression, and
/// more than a hundredth of the energy that everything could gain by falling through the scene.
void watch_energy(const Simulation& sim, const Totals& now);

/// The largest overlap of bodies with each other and with walls: of all steps so far, each as it
/// began, and of the state that the last one left [m].
double worst_penetration(const Simulation& sim);

/// Numbers of the bodies, fixed ones excepted, that are wholly below or beside the domain of the
/// fluid, for instance past the end of the ground or past a window that they missed. None without
/// fluid.
std::vector<int> bodies_outside(const Simulation& sim);

} // namespace hyoryu
