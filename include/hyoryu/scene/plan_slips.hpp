// SPDX-License-Identifier: MIT
// Warnings of input that is valid but probably unintended.
#pragma once

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// Warns of gravity that points upward, bodies far from all else, meshes in other units, walls
/// thinner than a spacing, and domains that cut the scene.
void warn_about_slips(const Scene& scene, Plan& plan);

/// The fluid block, wall or body that `domain` cuts, as messages name it; empty if it cuts none.
std::string cut_by_domain(const Scene& scene);

} // namespace hyoryu
