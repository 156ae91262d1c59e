// SPDX-License-Identifier: MIT
// A plan as text for people and as JSON for programs.
#pragma once

#include "hyoryu/scene/plan.hpp"

#include <string>

namespace hyoryu {

std::string plan_text(const Scene& scene, const Plan& plan);
std::string plan_json(const Scene& scene, const Plan& plan);

/// "1.2 GB" and the like.
std::string readable_bytes(double bytes);
/// "3 min 20 s" and the like.
std::string readable_seconds(double seconds);

} // namespace hyoryu
