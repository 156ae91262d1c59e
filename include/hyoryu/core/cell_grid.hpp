// SPDX-License-Identifier: MIT
// Points sorted into cubic cells by counting sort, so that the points near a place are a few
// contiguous runs.
#pragma once

#include "hyoryu/core/types.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace hyoryu {

/// The grid: x runs fastest, so cells that are neighbours in x hold consecutive points.
struct CellGrid {
    Vec3 origin{0, 0, 0};                // lower corner [m]
    real cell = 1;                       // edge length [m]
    std::array<Index, 3> count{0, 0, 0}; // cells along x, y, z
    std::vector<std::int32_t> start;     // first point of each cell; one entry more than cells
    std::vector<std::int32_t> order;     // rows in the order of the cells

    Index cells() const { return count[0] * count[1] * count[2]; }
    std::array<Index, 3> cell_of(const Vec3& point) const;
};

/// Sorts the points of the rows [first, first + points.size()) into cells of at least `cell` [m].
/// The order within a cell is that of the rows, whatever the number of threads.
void build(CellGrid& grid, std::span<const Vec3> points, Index first, real cell);

/// Calls f(row) for the points in the cells from `first` to `last`, both included; cells outside of
/// the grid have none.
void for_points_in(const CellGrid& grid, std::array<Index, 3> first, std::array<Index, 3> last,
                   const auto& f)
{
    for (std::size_t a = 0; a < 3; ++a) {
        first[a] = std::max<Index>(first[a], 0);
        last[a] = std::min(last[a], grid.count[a] - 1);
    }
    for (Index z = first[2]; z <= last[2]; ++z) {
        for (Index y = first[1]; y <= last[1] && first[0] <= last[0]; ++y) {
            const Index cells = (z * grid.count[1] + y) * grid.count[0];
            const auto end = grid.start[at(cells + last[0] + 1)];
            for (auto k = grid.start[at(cells + first[0])]; k < end; ++k) {
                f(at(grid.order[at(k)]));
            }
        }
    }
}

} // namespace hyoryu
