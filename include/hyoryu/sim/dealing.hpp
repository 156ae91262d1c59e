// SPDX-License-Identifier: MIT
// A case that several processes share is filled and planned by rank 0, which also reads its
// checkpoints. It deals out what the others need: each gets the fluid particles of its range of
// tiles, and none but rank 0 ever holds those of all. All functions are called by all ranks.
#pragma once

#include "hyoryu/core/snapshot.hpp"
#include "hyoryu/sim/simulation.hpp"

namespace hyoryu {

/// Gives the other ranks the part of the plan of rank 0 that a run goes by. `filling`, `plan`: of
/// rank 0; on the others the filling is not looked at and the plan is replaced.
void deal_plan(Comm& comm, const Scene& scene, const Filling& filling, Plan& plan);

} // namespace hyoryu
