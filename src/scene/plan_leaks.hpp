// SPDX-License-Identifier: MIT
// Water and bodies with nothing that holds them.
#pragma once

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// Warns of fluid that has no wall below it, of fluid beside a drop, as at the open side of a basin
/// with no ground beyond it, and of bodies with neither wall nor water in their column: all of them
/// fall out of the scene. Water that leaves by an `[[open]]` side or a period is not meant.
void warn_about_leaks(const Scene& scene, const Filling& filling, Plan& plan);

} // namespace hyoryu
