// SPDX-License-Identifier: MIT
// Points of water as rows of shaded rectangles.
#include "hyoryu/report/plan_view.hpp"
#include "hyoryu/report/svg.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hyoryu {

namespace {

constexpr double empty = -std::numeric_limits<double>::infinity();
constexpr int shades = 6;

/// The highest point of each cell of a picture.
struct Raster {
    double left = 0, low = 0, cell = 1; // [m]
    std::size_t columns = 0, rows = 0;
    std::vector<double> top; // by row and column [m]
};

Raster raster_of(const std::vector<float>& points, double spacing, View view)
{
    constexpr double most_cells = 260;
    const std::size_t up = view == View::xy ? 1 : 2;
    std::vector<double> x, y;
    for (std::size_t k = 0; k + 2 < points.size(); k += 3) {
        x.push_back(points[k]);
        y.push_back(points[k + up]);
    }
    const auto [left, right] = std::ranges::minmax(x);
    const auto [low, high] = std::ranges::minmax(y);
    Raster raster{.left = left, .low = low};
    raster.cell = std::max(spacing, std::max(right - left, high - low) / most_cells);
    const auto cell_of = [&](double value, double from) {
        return static_cast<std::size_t>((value - from) / raster.cell);
    };
    raster.columns = cell_of(right, left) + 1;
    raster.rows = cell_of(high, low) + 1;
    raster.top.assign(raster.columns * raster.rows, empty);
    for (std::size_t k = 0; k < x.size(); ++k) {
        double& top = raster.top[cell_of(y[k], low) * raster.columns + cell_of(x[k], left)];
        top = std::max(top, static_cast<double>(points[3 * k + 2]));
    }
    return raster;
}

/// The shade of a height, -1 without water.
int shade_of(double top, const std::array<double, 2>& heights)
{
    if (top == empty) {
        return -1;
    }
    const double width = std::max(heights[1] - heights[0], 1e-30);
    return std::clamp(static_cast<int>(shades * (top - heights[0]) / width), 0, shades - 1);
}

} // namespace

std::vector<WaterPatch> water_patches(const std::vector<float>& points, double spacing, View view,
                                      const std::array<double, 2>& heights)
{
    std::vector<WaterPatch> patches;
    if (points.empty()) {
        return patches;
    }
    const Raster raster = raster_of(points, spacing, view);
    for (std::size_t row = 0; row < raster.rows; ++row) {
        int before = -1;
        for (std::size_t column = 0; column < raster.columns; ++column) {
            const int shade = shade_of(raster.top[row * raster.columns + column], heights);
            if (shade >= 0 && shade == before) {
                patches.back().width += raster.cell;
            } else if (shade >= 0) {
                // A particle is at the centre of its cell.
                patches.push_back({raster.left + raster.cell * (static_cast<double>(column) - 0.5),
                                   raster.low + raster.cell * (static_cast<double>(row) - 0.5),
                                   raster.cell, raster.cell, shade / (shades - 1.0)});
            }
            before = shade;
        }
    }
    return patches;
}

} // namespace hyoryu
