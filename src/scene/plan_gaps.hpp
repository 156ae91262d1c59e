// SPDX-License-Identifier: MIT
// Gaps between walls that move and others, through which water passes.
#pragma once

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// Warns of each side of a moving obstacle that leaves water a gap of a spacing or more to a fixed
/// wall, as under a paddle that does not reach the floor. What is farther away than a tenth of the
/// obstacle's size, and than four spacings, is taken for meant.
void warn_about_gaps(const Scene& scene, const Filling& filling, Plan& plan);

} // namespace hyoryu
