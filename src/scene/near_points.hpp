// SPDX-License-Identifier: MIT
// Points about a place or about marked points.
#pragma once

#include "hyoryu/core/cell_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace hyoryu {

/// Calls f(begin, end) for the runs of entries of grid.order that hold the points in the cell of a
/// place and in those about it: all points within an edge of a cell. The place may be outside of
/// the grid.
void for_runs_about(const CellGrid& grid, const Vec3& place, const auto& f)
{
    std::array<Index, 3> first{};
    std::array<Index, 3> last{};
    for (std::size_t a = 0; a < 3; ++a) {
        const auto axis = static_cast<Eigen::Index>(a);
        const double cells = (place[axis] - grid.origin[axis]) / grid.cell;
        const auto home = static_cast<Index>(std::floor(std::clamp(cells, -2.0, 1e9)));
        first[a] = std::max<Index>(home - 1, 0);
        last[a] = std::min(home + 2, grid.count[a]);
    }
    for (Index z = first[2]; z < last[2]; ++z) {
        for (Index y = first[1]; y < last[1] && first[0] < last[0]; ++y) {
            const Index row = (z * grid.count[1] + y) * grid.count[0];
            f(static_cast<std::size_t>(grid.start[static_cast<std::size_t>(row + first[0])]),
              static_cast<std::size_t>(grid.start[static_cast<std::size_t>(row + last[0])]));
        }
    }
}

/// Calls f(k) for the points k of those runs.
void for_cells_about(const CellGrid& grid, const Vec3& place, const auto& f)
{
    for_runs_about(grid, place, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            f(static_cast<std::size_t>(grid.order[k]));
        }
    });
}

/// Marks of the points within a distance [m] of some places.
std::vector<std::uint8_t> marks_near(std::span<const Vec3> points, std::span<const Vec3> places,
                                     double distance);

/// Marks of the points within a distance [m] of marked ones, which stay marked.
std::vector<std::uint8_t> marks_about(std::span<const Vec3> points,
                                      std::span<const std::uint8_t> marked, double distance);

} // namespace hyoryu
