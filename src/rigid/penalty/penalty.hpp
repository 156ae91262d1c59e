// SPDX-License-Identifier: MIT
// A step by the penalty method.
#pragma once

#include "rigid/motion/memory.hpp"

namespace hyoryu {

/// Advances all bodies by the explicit symplectic Euler scheme in equal sub-steps. The log gets one
/// entry of kind `resting` for each pair of bodies, or body and boundary, that pushed: its normal
/// is the direction of the summed pair forces, its tangential impulse the sum of their friction,
/// its point their mean weighted by force, its loss what dashpots and friction took.
void step_by_penalty(const StepContext& context);

} // namespace hyoryu
