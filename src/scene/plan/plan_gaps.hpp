// SPDX-License-Identifier: MIT
// Gaps between walls that move and others, through which water passes.
#pragma once

#include "plan_facts.hpp"

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// Warns of each side of a moving obstacle that leaves water a gap of a spacing or more to a fixed
/// wall, as under a paddle that does not reach the floor. A gap wider than a tenth of the obstacle
/// and four spacings is taken as intended.
void warn_about_gaps(const Scene& scene, const PlanFacts& facts, Plan& plan);

} // namespace hyoryu
