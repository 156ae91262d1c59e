// SPDX-License-Identifier: MIT
// Watches every step for numbers that went wrong.
#pragma once

namespace hyoryu {

struct Simulation;

/// Throws NumericalError that names the particle or body, the field and the probable cause when the
/// state is not finite, or a density or speed is beyond what a weakly compressible flow can have.
void watch(Simulation& sim);

} // namespace hyoryu
