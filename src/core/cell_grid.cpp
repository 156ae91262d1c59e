// SPDX-License-Identifier: MIT
// Counting sort of points into the cells of a uniform grid.
#include "hyoryu/core/cell_grid.hpp"

#include "hyoryu/core/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Upper limit of the number of cells, above which they cost more than they save; beyond it the
// cells are made larger.
constexpr real most_cells = 5e7;

struct Bounds {
    Vec3 min{infinity, infinity, infinity};
    Vec3 max{-infinity, -infinity, -infinity};
};

Bounds bounds_of(std::span<const Vec3> points)
{
    return reduce(
        0, static_cast<Index>(points.size()), Bounds{},
        [&](Index k) {
            const Vec3& point = points[static_cast<std::size_t>(k)];
            return Bounds{point, point};
        },
        [](const Bounds& a, const Bounds& b) {
            return Bounds{a.min.cwiseMin(b.min), a.max.cwiseMax(b.max)};
        });
}

void lay_out(CellGrid& grid, const Bounds& box, real cell)
{
    const Vec3 extent = box.max - box.min;
    // The cells grow by the rounding of positions in single precision, so that a search of the
    // radius they were made for reaches no further.
    grid.cell = cell + static_cast<float>(extent.maxCoeff() * 4e-7);
    const Vec3 wanted = extent / grid.cell + Vec3::Ones();
    if (wanted.prod() > most_cells) {
        grid.cell *= std::cbrt(wanted.prod() / most_cells);
    }
    grid.origin = box.min;
    for (int axis = 0; axis < 3; ++axis) {
        grid.count[static_cast<std::size_t>(axis)] =
            static_cast<Index>(extent[axis] / grid.cell) + 1;
    }
}

} // namespace

std::array<Index, 3> CellGrid::cell_of(const Vec3& point) const
{
    std::array<Index, 3> at{};
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        at[k] = static_cast<Index>(std::floor((point[axis] - origin[axis]) / cell));
    }
    return at;
}

void build(CellGrid& grid, std::span<const Vec3> points, Index first, real cell)
{
    const auto n = static_cast<Index>(points.size());
    grid.order.resize(points.size());
    if (n == 0) {
        grid.count = {0, 0, 0};
        grid.start.assign(1, 0);
        return;
    }
    lay_out(grid, bounds_of(points), cell);

    std::vector<std::int32_t> cell_index(points.size());
    parallel_for(0, n, [&](Index k) {
        const auto at = grid.cell_of(points[static_cast<std::size_t>(k)]);
        cell_index[static_cast<std::size_t>(k)] =
            static_cast<std::int32_t>(at[0] + grid.count[0] * (at[1] + grid.count[1] * at[2]));
    });
    grid.start.assign(static_cast<std::size_t>(grid.cells()) + 1, 0);
    for (const std::int32_t c : cell_index) {
        ++grid.start[static_cast<std::size_t>(c) + 1];
    }
    for (std::size_t c = 1; c < grid.start.size(); ++c) {
        grid.start[c] += grid.start[c - 1];
    }
    std::vector<std::int32_t> next(grid.start.begin(), grid.start.end() - 1);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const std::int32_t slot = next[static_cast<std::size_t>(cell_index[k])]++;
        grid.order[static_cast<std::size_t>(slot)] =
            static_cast<std::int32_t>(first + static_cast<Index>(k));
    }
}

} // namespace hyoryu
