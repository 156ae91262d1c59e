// SPDX-License-Identifier: MIT
// Flotation of bodies and consequences of the resolution, as text and as JSON of a plan.
#pragma once

#include "hyoryu/scene/plan.hpp"

#include <nlohmann/json_fwd.hpp>

namespace hyoryu {

/// The parts "floating bodies" and "scale" of the text of a plan; empty without fluid.
std::string scale_lines(const Plan& plan);

/// Adds `floating` and `scale` to the JSON of a plan.
void add_scale(const Plan& plan, nlohmann::ordered_json& json);

} // namespace hyoryu
