// SPDX-License-Identifier: MIT
// The surface of a terrain against its grid, with grounds for which the differences are known.
#include "dice.hpp"
#include "hyoryu/geometry/surface_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace hyoryu::test_surface_check {
namespace {

// A grid of cells of `cell` about the origin, 60 m each way.
HeightGrid grid_of(double cell, const std::function<double(double, double)>& ground)
{
    HeightGrid grid;
    grid.columns = grid.rows = static_cast<Index>(120 / cell) + 1;
    grid.first = {-60, -60};
    grid.cell = {cell, cell};
    for (Index j = 0; j < grid.rows; ++j) {
        for (Index i = 0; i < grid.columns; ++i) {
            grid.height.push_back(
                ground(-60 + static_cast<double>(i) * cell, -60 + static_cast<double>(j) * cell));
        }
    }
    return grid;
}

SurfaceCheck checked(const HeightGrid& grid, const TerrainPatch& patch)
{
    return check_surface(grid, patch, sample_heights(grid, patch));
}

TEST(SurfaceCheck, APlaneIsFollowedInAnyAxes)
{
    Dice dice(51);
    for (int k = 0; k < 20; ++k) {
        const double a = dice.between(-0.9, 0.9);
        const double b = dice.between(-0.4, 0.4);
        const HeightGrid grid = grid_of(2, [&](double x, double y) { return a * x + b * y; });
        const TerrainPatch patch{.azimuth_deg = dice.between(0, 360),
                                 .datum = dice.between(-3, 3),
                                 .extent = {-20, -20, 20, 20},
                                 .resolution = dice.between(0.5, 2)};
        const SurfaceCheck check = checked(grid, patch);
        EXPECT_LT(check.largest, 1e-9) << k;
        EXPECT_EQ(check.steep, 0) << k;
        EXPECT_NEAR(static_cast<double>(check.compared), 1600 / 4, 45); // 40 m by 40 m, the rim
        EXPECT_GT(check.highest, patch.datum);
    }
}

// A coarse surface takes means: of a parabola of curvature q they differ by what the mean over a
// cell of edge L and the chord of it give, q L^2 / 24 and up to q L^2 / 8.
TEST(SurfaceCheck, ACoarseSurfaceDiffersByItsMeans)
{
    for (const double resolution : {4.0, 8.0}) {
        const double q = 0.02;
        const HeightGrid grid = grid_of(1, [&](double x, double) { return q * x * x / 2; });
        const SurfaceCheck check =
            checked(grid, {.extent = {-40, -40, 40, 40}, .resolution = resolution});
        const double chord = q * resolution * resolution / 8;
        const double mean = q * (resolution * resolution - 1) / 24; // of whole metres
        EXPECT_GT(check.largest, chord);
        // Means at the rim are of one side: half a cell of the slope of q 40 m.
        EXPECT_LT(check.largest, chord + mean + q * 40 * resolution / 4);
        EXPECT_GT(check.rms, mean / 2);
        EXPECT_LT(check.rms, check.largest);
        EXPECT_EQ(std::abs(check.at[0]) > 30, true);
    }
}

TEST(SurfaceCheck, AStepIsFoundAndALevelAreaIsNoDifference)
{
    const HeightGrid grid = grid_of(2, [](double x, double) { return x > 5 ? 3.2 : 0.0; });
    TerrainPatch patch{.extent = {-20, -20, 20, 20}, .resolution = 2};
    SurfaceCheck check = checked(grid, patch);
    EXPECT_EQ(check.steep, 20); // one cell across, 20 along
    EXPECT_NEAR(check.step, 3.2, 1e-12);
    EXPECT_NEAR(check.step_at[0], 5, 1);
    EXPECT_LT(check.largest, 1e-12);
    patch.levels.push_back({{{-20.5, -20.5}, {-9.5, -20.5}, {-9.5, 20.5}, {-20.5, 20.5}}, 1.8});
    check = checked(grid, patch);
    EXPECT_LT(check.largest, 1e-12);
    EXPECT_EQ(check.compared, (21 - 6) * 21);
    EXPECT_EQ(check.steep, 20); // 1.8 m within 2 m is below 45 degrees
}

// The last area counts, and a lattice point is within or not whatever the axes.
TEST(SurfaceCheck, LevelAreasSetTheirPoints)
{
    Dice dice(52);
    for (int k = 0; k < 20; ++k) {
        const HeightGrid grid = grid_of(2, [](double, double) { return 0.0; });
        TerrainPatch patch{.azimuth_deg = dice.between(0, 360),
                           .datum = 0.5,
                           .extent = {-20, -20, 20, 20},
                           .resolution = dice.between(0.7, 2)};
        const double r = dice.between(5, 12);
        Ring ring; // a circle: its inside is known without a ring
        for (int c = 0; c < 720; ++c) {
            const double angle = std::numbers::pi * c / 360;
            ring.push_back({3 + r * std::cos(angle), r * std::sin(angle)});
        }
        patch.levels = {{ring, 9.0}, {ring, 1.8}};
        const std::vector<double> heights = sample_heights(grid, patch);
        const auto [columns, rows] = lattice_cells(patch);
        Index inside = 0;
        for (Index n = 0; n < std::ssize(heights); ++n) {
            const double x =
                -20 + 40.0 * static_cast<double>(n % (columns + 1)) / static_cast<double>(columns);
            const double y =
                -20 + 40.0 * static_cast<double>(n / (columns + 1)) / static_cast<double>(rows);
            const double away = std::hypot(x - 3, y) - r;
            if (std::abs(away) > 1e-3) { // the circle is a polygon
                EXPECT_EQ(heights[static_cast<std::size_t>(n)], away < 0 ? 1.8 : 0.5);
            }
            inside += heights[static_cast<std::size_t>(n)] == 1.8 ? 1 : 0;
        }
        EXPECT_EQ(points_within(patch, ring), inside);
    }
}

} // namespace
} // namespace hyoryu::test_surface_check
