// SPDX-License-Identifier: MIT
// Bounds of chunks in single precision, and the rounding errors that the searches allow for.
#pragma once

#include "hyoryu/core/tiles.hpp"

#include <algorithm>

namespace hyoryu {

/// Bound on the rounding error of positions and squared distances in single precision, relative to
/// the edge of a tile [1].
inline constexpr float rounding_of_positions = 2e-6F;

/// The step from a tile to the one `way` tiles away, by axis [m].
inline std::array<float, 3> step_to(const Vec3& edge, const std::array<int, 3>& way)
{
    return {static_cast<float>(edge.x()) * static_cast<float>(way[0]),
            static_cast<float>(edge.y()) * static_cast<float>(way[1]),
            static_cast<float>(edge.z()) * static_cast<float>(way[2])};
}

inline ChunkBox shifted(ChunkBox box, const std::array<float, 3>& step)
{
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] += step[axis];
        box.high[axis] += step[axis];
    }
    return box;
}

inline ChunkBox joined(ChunkBox a, const ChunkBox& b)
{
    for (std::size_t axis = 0; axis < 3; ++axis) {
        a.low[axis] = std::min(a.low[axis], b.low[axis]);
        a.high[axis] = std::max(a.high[axis], b.high[axis]);
    }
    return a;
}

inline bool is_near(const ChunkBox& a, const ChunkBox& b, float squared_radius)
{
    float squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float gap = std::max({b.low[axis] - a.high[axis], a.low[axis] - b.high[axis], 0.0F});
        squared += gap * gap;
    }
    return squared <= squared_radius;
}

} // namespace hyoryu
