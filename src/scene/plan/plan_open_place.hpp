// SPDX-License-Identifier: MIT
// Where the windows of a scene may lie, and the bodies at them.
#pragma once

#include "plan_facts.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/fluid/open_boundary.hpp"
#include "hyoryu/scene/scene.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hyoryu {

/// A fault of a key of a window.
Diagnostic note_at(const Scene& scene, const OpenSettings& open, std::string_view key,
                   std::string what, std::string hint);

/// Adds a fault if the plane is that of the other side of the domain; whether it does, so that
/// nothing else of the window can be checked.
bool points_out(const Scene& scene, const PlanFacts& facts, const OpenSettings& open,
                std::vector<Diagnostic>& errors);

/// Adds a fault unless the plane is that of a side of the domain, the lower one for +x and +y.
void check_side(const Scene& scene, const PlanFacts& facts, const OpenSettings& open,
                std::vector<Diagnostic>& errors);

/// Adds a fault for each body that stands across the window; whether none does. Such a body also
/// moves the side of the domain.
bool bodies_are_inside(const Scene& scene, const OpenSettings& open, const OpenSide& side,
                       std::vector<Diagnostic>& errors);

/// Adds faults of windows at which bodies stop.
void check_bodies_that_stop(const Scene& scene, const OpenSettings& open,
                            std::vector<Diagnostic>& errors);

} // namespace hyoryu
