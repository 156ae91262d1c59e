// SPDX-License-Identifier: MIT
// The part of the plan on contact between bodies.
#pragma once

#include "plan_facts.hpp"

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// Names the method and the law of contact, on or off with a reason, and every pair of materials
/// that can meet; warns of penalty sub-steps that are too long.
void list_contact(const Scene& scene, const PlanFacts& facts, Plan& plan);

} // namespace hyoryu
