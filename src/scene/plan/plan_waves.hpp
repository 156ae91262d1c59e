// SPDX-License-Identifier: MIT
// Warnings of waves and their dampers that are valid but probably unintended.
#pragma once

#include "plan_facts.hpp"

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// Warns of waves that break at once (higher than 0.78 of the depth, McCowan 1894, or steeper than
/// 0.142 tanh(k d), Miche 1944), of paddles whose depth is not that of the water before them, and
/// of sponges and paddles that have no water to damp.
void warn_about_waves(const Scene& scene, const PlanFacts& facts, Plan& plan);

} // namespace hyoryu
