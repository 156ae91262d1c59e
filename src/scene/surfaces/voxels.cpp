// SPDX-License-Identifier: MIT
#include "hyoryu/scene/voxels.hpp"

#include <array>
#include <cmath>
#include <set>

namespace hyoryu {

namespace {

constexpr double on_lattice = 1e-6; // of a cell

using VoxelCell = std::array<long long, 3>; // z y x: the order in which boxes grow
using VoxelCells = std::set<VoxelCell>;

// The cells on the lattice of the first point; fewer than points if one is off it or taken.
VoxelCells cells_of(const std::vector<Vec3>& points, const Vec3& cell)
{
    VoxelCells cells;
    for (const Vec3& p : points) {
        const Vec3 steps = (p - points.front()).cwiseQuotient(cell);
        const Vec3 whole = steps.array().round();
        if ((steps - whole).cwiseAbs().maxCoeff() <= on_lattice) {
            cells.insert(
                {std::llround(whole.z()), std::llround(whole.y()), std::llround(whole.x())});
        }
    }
    return cells;
}

// Takes the largest box out that begins at the first cell.
std::array<VoxelCell, 2> take_box(VoxelCells& cells)
{
    const VoxelCell low = *cells.begin();
    VoxelCell high = low;
    const auto all = [&](const VoxelCell& from, const VoxelCell& to) {
        for (long long k = from[0]; k <= to[0]; ++k) {
            for (long long j = from[1]; j <= to[1]; ++j) {
                for (long long i = from[2]; i <= to[2]; ++i) {
                    if (!cells.contains({k, j, i})) {
                        return false;
                    }
                }
            }
        }
        return true;
    };
    for (const std::size_t axis : {2U, 1U, 0U}) {
        while (true) {
            VoxelCell from = low;
            VoxelCell to = high;
            from[axis] = to[axis] = high[axis] + 1;
            if (!all(from, to)) {
                break;
            }
            ++high[axis];
        }
    }
    for (long long k = low[0]; k <= high[0]; ++k) {
        for (long long j = low[1]; j <= high[1]; ++j) {
            for (long long i = low[2]; i <= high[2]; ++i) {
                cells.erase({k, j, i});
            }
        }
    }
    return {low, high};
}

Vec3 place_of_voxel(const VoxelCell& c, const Vec3& origin, const Vec3& cell)
{
    return origin + cell.cwiseProduct(Vec3(static_cast<double>(c[2]), static_cast<double>(c[1]),
                                           static_cast<double>(c[0])));
}

} // namespace

std::optional<std::vector<Bounds>> merged_cells(const std::vector<Vec3>& points, const Vec3& cell)
{
    VoxelCells cells = cells_of(points, cell);
    if (points.empty() || cells.size() != points.size()) {
        return std::nullopt;
    }
    std::vector<Bounds> boxes;
    while (!cells.empty()) {
        const auto [low, high] = take_box(cells);
        boxes.push_back({place_of_voxel(low, points.front(), cell) - cell / 2,
                         place_of_voxel(high, points.front(), cell) + cell / 2});
    }
    return boxes;
}

Index exposed_cells(const std::vector<Vec3>& points, const Vec3& cell)
{
    const VoxelCells cells = cells_of(points, cell);
    Index exposed = 0;
    for (const VoxelCell& c : cells) {
        bool inner = true;
        for (std::size_t axis = 0; axis < 3 && inner; ++axis) {
            for (const long long step : {-1LL, 1LL}) {
                VoxelCell next = c;
                next[axis] += step;
                inner = inner && cells.contains(next);
            }
        }
        exposed += inner ? 0 : 1;
    }
    return exposed + static_cast<Index>(points.size() - cells.size());
}

} // namespace hyoryu
