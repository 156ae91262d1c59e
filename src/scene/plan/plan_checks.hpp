// SPDX-License-Identifier: MIT
// Errors and warnings that depend on the filled scene.
#pragma once

#include "plan_facts.hpp"

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// Adds warnings to the plan; throws CaseError with every mistake found.
void check_plan(const Scene& scene, const PlanFacts& facts, Plan& plan);

} // namespace hyoryu
