// SPDX-License-Identifier: MIT
// The hits of the last barrier on walls and bodies.
#pragma once

#include "hyoryu/sim/wall_barrier.hpp"

namespace hyoryu {

struct Simulation;

/// Changes a velocity [m/s] until it satisfies every surface, with the least change that does, by
/// up to four rounds of projected Gauss-Seidel: a surface takes back what it has given where others
/// have made it needless. Where no velocity satisfies all, the walls, which come last, are
/// satisfied. Returns the change in the last round relative to that in the first.
double settle(Vec3& velocity, std::span<SurfaceHold> holds);

/// Adds the reactions of the hits of a step to the sums of the loads, constant over the step.
void book_hits(Simulation& sim);

} // namespace hyoryu
