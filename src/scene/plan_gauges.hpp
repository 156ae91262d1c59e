// SPDX-License-Identifier: MIT
// What gauges read and cost, and whether they stand where they can read anything.
#pragma once

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// Fills in `plan.gauges` and what they cost.
void list_gauges(const Scene& scene, Plan& plan);

/// Appends an error for each gauge outside the domain, and warns of those inside a wall.
void check_gauges(const Scene& scene, const Filling& filling, Plan& plan,
                  std::vector<Diagnostic>& errors);

} // namespace hyoryu
