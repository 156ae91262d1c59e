// SPDX-License-Identifier: MIT
// The columns and the cost of gauges, and whether their places allow any reading.
#pragma once

#include "plan_facts.hpp"

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// Fills in `plan.gauges` and their cost.
void list_gauges(const Scene& scene, Plan& plan);

/// Appends an error for each gauge outside the domain, and warns of those inside a wall.
void check_gauges(const Scene& scene, const PlanFacts& facts, Plan& plan,
                  std::vector<Diagnostic>& errors);

} // namespace hyoryu
