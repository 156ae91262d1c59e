// SPDX-License-Identifier: MIT
// Detection of instability: checks of the state after each step.
#pragma once

#include "hyoryu/sim/conservation.hpp"

namespace hyoryu {

struct Simulation;

/// Keeps the largest compression of the fluid and throws NumericalError that names
/// the particle or body, what lies around it and the probable cause when the state is not finite, a
/// density or speed is beyond what a weakly compressible flow can have, a moving wall crushes a
/// body against a fixed solid, or solids overlap by more than the inner radius of the
/// thinnest body.
void watch(Simulation& sim);

/// Throws NumericalError when a run that nothing drives (no moving wall, no acceleration, impulses
/// with the coupled law) has gained more than half of the energy that its motion and compression
/// hold, and more than a hundredth of what all could gain by falling through the scene.
void watch_energy(const Simulation& sim, const Totals& now);

} // namespace hyoryu
