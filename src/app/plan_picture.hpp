// SPDX-License-Identifier: MIT
// The scene from above, before anything runs.
#pragma once

#include "hyoryu/io/png.hpp"
#include "hyoryu/scene/fill.hpp"

namespace hyoryu {

/// Ground in the colours of its height, buildings and other solids, water in the colours of its
/// depth, and bodies, at the start of a case in three dimensions. x points to the right.
Pixels plan_picture(const Scene& scene, const Filling& filling);

} // namespace hyoryu
