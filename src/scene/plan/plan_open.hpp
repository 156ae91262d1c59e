// SPDX-License-Identifier: MIT
// The parts of a plan on open sides: their list, and checks of their windows.
#pragma once

#include "plan_facts.hpp"

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// Lists the open sides and estimates the largest number of particles that they add.
void list_open(const Scene& scene, const PlanFacts& facts, Plan& plan);

/// Adds the faults of windows that only the filled scene shows, and warns.
void check_open(const Scene& scene, const PlanFacts& facts, Plan& plan,
                std::vector<Diagnostic>& errors);

} // namespace hyoryu
