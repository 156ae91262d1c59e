// SPDX-License-Identifier: MIT
// The sides of the triangles of a surface, sorted so that those along one edge stand together.
#pragma once

#include "hyoryu/core/types.hpp"

#include <algorithm>
#include <array>
#include <compare>
#include <span>
#include <vector>

namespace hyoryu {

/// A side of a triangle by the numbers of its two corners, the lower one first.
struct TriangleSide {
    int low = 0, high = 0;
    int triangle = 0;
    int side = 0; // of its triangle, from corner `side` to the next one
    auto operator<=>(const TriangleSide&) const = default;
};

/// The sides of all triangles, given by their corners, in the order of their members.
inline std::vector<TriangleSide> sorted_sides(std::span<const std::array<int, 3>> triangles)
{
    std::vector<TriangleSide> all;
    all.reserve(3 * triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(triangles[t][k], triangles[t][(k + 1) % 3]);
            all.push_back({low, high, static_cast<int>(t), static_cast<int>(k)});
        }
    }
    std::ranges::sort(all);
    return all;
}

} // namespace hyoryu
