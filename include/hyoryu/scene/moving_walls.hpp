// SPDX-License-Identifier: MIT
// Whether a scene has walls that move.
#pragma once

#include "hyoryu/core/motion.hpp"
#include "hyoryu/scene/scene.hpp"

#include <algorithm>

namespace hyoryu {

/// Whether any wall of the scene ever moves.
inline bool has_moving_walls(const Scene& scene)
{
    return std::ranges::any_of(scene.walls, [](const Wall& wall) { return moves(wall.motion); });
}

} // namespace hyoryu
