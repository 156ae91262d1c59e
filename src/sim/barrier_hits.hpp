// SPDX-License-Identifier: MIT
// The hits of the last barrier on walls and bodies.
#pragma once

namespace hyoryu {

struct Simulation;

/// Adds the reactions of the hits of a step to the sums of the loads, constant over the step.
void book_hits(Simulation& sim);

} // namespace hyoryu
