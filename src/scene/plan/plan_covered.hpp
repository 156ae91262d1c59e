// SPDX-License-Identifier: MIT
// Warnings of moving walls that the water does not feel.
#pragma once

#include "plan_facts.hpp"

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// Warns of moving walls of which a part of the surface lies in that of a fixed wall during the
/// whole run, as a lid in the closed upper side of a basin: fixed walls act there, moving ones do
/// not (see scene/covered_share.hpp).
void warn_about_covered_walls(const Scene& scene, const PlanFacts& facts, Plan& plan);

} // namespace hyoryu
