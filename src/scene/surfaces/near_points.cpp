// SPDX-License-Identifier: MIT
#include "near_points.hpp"

namespace hyoryu {

std::vector<std::uint8_t> marks_near(std::span<const Vec3> points, std::span<const Vec3> places,
                                     double distance)
{
    CellGrid grid;
    build(grid, points, 0, distance);
    std::vector<std::uint8_t> near(points.size(), 0);
    for (const Vec3& place : places) {
        for_cells_about(grid, place, [&](std::size_t j) {
            near[j] = (place - points[j]).norm() < distance ? 1 : near[j];
        });
    }
    return near;
}

} // namespace hyoryu
