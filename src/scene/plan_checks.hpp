// SPDX-License-Identifier: MIT
// Mistakes and doubts that only the filled scene shows.
#pragma once

#include "plan_facts.hpp"

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// Adds warnings to the plan; throws CaseError with every mistake found.
void check_plan(const Scene& scene, const PlanFacts& facts, Plan& plan);

} // namespace hyoryu
