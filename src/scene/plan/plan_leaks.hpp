// SPDX-License-Identifier: MIT
// Warnings of water and bodies that nothing supports.
#pragma once

#include "plan_facts.hpp"

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// Warns of fluid that has no wall below it, of a drop that it may flow to over walls that are
/// lower than its surface or below walls over a gap, as beyond the open side of a basin without
/// ground, and of bodies with neither wall nor water in their columns: all of them fall out of the
/// scene. Water that leaves through an `[[open]]` side or a period is ignored. No warnings unless
/// gravity points along -z.
void warn_about_leaks(const Scene& scene, const PlanFacts& facts, Plan& plan);

} // namespace hyoryu
