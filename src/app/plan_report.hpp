// SPDX-License-Identifier: MIT
// A plan as text for people and as JSON for programs.
#pragma once

#include "hyoryu/sim/cost.hpp"

#include <optional>
#include <string>

namespace hyoryu {

/// The forecast of the run time is an order of magnitude, unless steps were timed on this machine.
std::string plan_text(const Scene& scene, const Plan& plan,
                      const std::optional<StepCost>& timed = {});
/// `processes`: that share the run.
std::string plan_json(const Scene& scene, const Plan& plan,
                      const std::optional<StepCost>& timed = {}, int processes = 1);

/// "1.2 GB" and the like.
std::string readable_bytes(double bytes);
/// "3 min 20 s" and the like.
std::string readable_seconds(double seconds);

} // namespace hyoryu
