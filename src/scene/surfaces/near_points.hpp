// SPDX-License-Identifier: MIT
// Points about some places.
#pragma once

#include "hyoryu/core/cell_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace hyoryu {

/// Calls f(k) for the points k in the cell of a place and in those about it: all points within an
/// edge of a cell. The place may be outside of the grid.
void for_cells_about(const CellGrid& grid, const Vec3& place, const auto& f)
{
    std::array<Index, 3> first{};
    std::array<Index, 3> last{};
    for (int axis = 0; axis < 3; ++axis) {
        const double cells = (place[axis] - grid.origin[axis]) / grid.cell;
        const auto home = static_cast<Index>(std::floor(std::clamp(cells, -2.0, 1e9)));
        first[at(axis)] = home - 1;
        last[at(axis)] = home + 1;
    }
    for_points_in(grid, first, last, f);
}

/// Marks of the points within a distance [m] of some places.
std::vector<std::uint8_t> marks_near(std::span<const Vec3> points, std::span<const Vec3> places,
                                     double distance);

} // namespace hyoryu
