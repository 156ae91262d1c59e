// SPDX-License-Identifier: MIT
// What a plan says of open sides.
#pragma once

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// Lists the open sides and estimates the largest number of particles that they add.
void list_open(const Scene& scene, const Filling& filling, Plan& plan);

/// Level of the water before a window at the start [m]; -infinity where it is dry.
double level_before(const Scene& scene, const Filling& filling, const OpenSettings& open);

/// Adds the faults of windows that only the filled scene shows, and warns.
void check_open(const Scene& scene, const Filling& filling, Plan& plan,
                std::vector<Diagnostic>& errors);

} // namespace hyoryu
