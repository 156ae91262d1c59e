// SPDX-License-Identifier: MIT
// Points sorted into cubic cells by counting sort, so that the points near a place are a few
// contiguous runs.
#pragma once

#include "hyoryu/core/types.hpp"

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
    // Positions in the order of the cells, relative to the origin, as the search reads them. Single
    // precision finds candidates; `slack` covers its rounding.
    std::vector<float> x, y, z;
    float slack = 0; // [m]

    Index cells() const { return count[0] * count[1] * count[2]; }
    std::array<Index, 3> cell_of(const Vec3& point) const;
};

/// Sorts the points of the rows [first, first + points.size()) into cells of at least `cell` [m].
/// The order within a cell is that of the rows, whatever the number of threads.
void build(CellGrid& grid, std::span<const Vec3> points, Index first, real cell);

} // namespace hyoryu
