// SPDX-License-Identifier: MIT
// Grids drawn at random, written in the dialects that users have, and read back; surfaces against
// the function that the heights were taken from.
#include "dice.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/geometry/height_grid.hpp"
#include "own_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>
#include <numbers>
#include <sstream>

namespace hyoryu::test_height_grid {
namespace {

namespace fs = std::filesystem;

using Ground = std::function<double(double, double)>; // height at easting and northing [m]

HeightGrid draw_grid(Dice& dice, const Ground& ground)
{
    HeightGrid grid;
    grid.columns = 2 + dice.below(39);
    grid.rows = 2 + dice.below(39);
    grid.first = {dice.between(3e5, 4e5), dice.between(4e6, 5e6)};
    grid.cell = {dice.between(0.5, 5), dice.between(0.5, 5)};
    for (Index j = 0; j < grid.rows; ++j) {
        for (Index i = 0; i < grid.columns; ++i) {
            grid.height.push_back(ground(grid.first[0] + static_cast<double>(i) * grid.cell[0],
                                         grid.first[1] + static_cast<double>(j) * grid.cell[1]));
        }
    }
    return grid;
}

// The text of a grid in one of the dialects.
std::string text_of(const HeightGrid& grid, bool by_corner, bool number_first, bool capitals)
{
    std::ostringstream text;
    text << std::setprecision(17);
    const auto line = [&](std::string key, double value) {
        if (capitals) {
            std::ranges::transform(key, key.begin(),
                                   [](unsigned char c) { return std::toupper(c); });
        }
        if (number_first) {
            text << "   " << value << "  " << key << "\r\n";
        } else {
            text << key << "  " << value << "\n";
        }
    };
    const double half = by_corner ? 0.5 : 0;
    const std::string end = by_corner ? "corner" : "center";
    line("ncols", static_cast<double>(grid.columns));
    line("nrows", static_cast<double>(grid.rows));
    line("xll" + end, grid.first[0] - half * grid.cell[0]);
    line("yll" + end, grid.first[1] - half * grid.cell[1]);
    line("dx", grid.cell[0]);
    line("dy", grid.cell[1]);
    line("NODATA_value", -9999);
    for (Index j = grid.rows - 1; j >= 0; --j) {
        for (Index i = 0; i < grid.columns; ++i) {
            text << grid.height[static_cast<std::size_t>(j * grid.columns + i)] << ' ';
        }
        text << '\n';
    }
    return text.str();
}

class HeightGrids : public testing::Test {
protected:
    HeightGrid read(const std::string& text, std::optional<double> substitute = {})
    {
        std::ofstream(file_, std::ios::binary) << text;
        return read_height_grid(file_, substitute);
    }
    std::string fault(const std::string& text)
    {
        try {
            read(text);
        } catch (const IoError& error) {
            return std::string(error.what()).substr(file_.string().size());
        }
        return "none";
    }

    OwnFolder folder_;
    fs::path file_ = folder_ / "heights.asc";
};

TEST_F(HeightGrids, AreReadInEveryDialect)
{
    Dice dice(1);
    for (int k = 0; k < 40; ++k) {
        const HeightGrid grid =
            draw_grid(dice, [&](double, double) { return dice.between(-9, 9); });
        const HeightGrid found = read(text_of(grid, k % 2 == 0, k % 4 < 2, k % 8 < 4));
        ASSERT_EQ(found.columns, grid.columns);
        ASSERT_EQ(found.rows, grid.rows);
        EXPECT_EQ(found.height, grid.height);
        for (std::size_t axis = 0; axis < 2; ++axis) {
            EXPECT_NEAR(found.first[axis], grid.first[axis], 1e-9 * grid.first[axis]);
            EXPECT_EQ(found.cell[axis], grid.cell[axis]);
        }
    }
}

// A row with one height too few or too many, among rows of the right length. Where the heights are
// wrapped after any number of words, no line is odd.
TEST_F(HeightGrids, TheOddRowIsNamed)
{
    Dice dice(7);
    for (int k = 0; k < 40; ++k) {
        HeightGrid grid = draw_grid(dice, [&](double, double) { return dice.between(-9, 9); });
        if (grid.rows < 4) {
            continue;
        }
        std::istringstream lines(text_of(grid, false, false, false));
        const int odd = 7 + dice.below(static_cast<int>(grid.rows)); // after 7 lines of header
        const bool short_row = dice.chance(0.5);
        std::string text, wrapped, line;
        for (int n = 0; std::getline(lines, line); ++n) {
            if (n == odd) {
                line = short_row ? line.substr(line.find(' ') + 1) : "1.5 " + line;
            }
            text += line + "\n";
            wrapped += line + (n < 7 || n % 2 == 0 ? "\n" : " ");
        }
        const Index held = grid.columns + (short_row ? -1 : 1);
        EXPECT_THAT(fault(text),
                    testing::StartsWith(fmt::format(":{}: this row holds {} heights, and `ncols` "
                                                    "is {}; ",
                                                    odd + 1, held, grid.columns)));
        EXPECT_THAT(fault(wrapped), testing::HasSubstr(short_row ? ": the file ends after "
                                                                 : ": there are more than "));
    }
}

TEST_F(HeightGrids, MistakesHaveTheirLine)
{
    const std::string head = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
    EXPECT_EQ(fault(head + "1 2\n3 4\n"), "none");
    EXPECT_EQ(fault("\xef\xbb\xbf" + head + "1 2\n3 4\n"), "none") << "a byte order mark";
    EXPECT_EQ(fault(head + "1 2\n3 x\n"), ":7: expected a height, found \"x\"");
    EXPECT_EQ(fault(head + "1 2\n3\n"), ":8: the file ends after 3 of 4 heights");
    EXPECT_EQ(fault(head + "1 2\n3 4 5\n"), ":7: there are more than 4 heights");
    EXPECT_EQ(fault(head + "cellsize 2\n1 2\n3 4\n"), ":6: `cellsize` is given twice");
    EXPECT_EQ(fault("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\n1 2\n3 4\n"),
              ":5: the header has no `dx`");
    EXPECT_EQ(fault("ncols 2\nnrows 2\nxllcorner 0\ncellsize 1\n1 2\n3 4\n"),
              ":5: the header has neither `yllcorner` nor `yllcenter`");
    EXPECT_EQ(fault("rows 2\n"),
              ":1: expected a key of an ESRI ASCII grid and its number, found \"rows 2\"");
    EXPECT_NE(fault("ncols 1e9\nnrows 1e9\nxllcorner 0\nyllcorner 0\ncellsize 1\n1\n")
                  .find("cells is not supported"),
              std::string::npos);
    EXPECT_NE(fault("ncols 2\nnrows 2\nxllcorner 141\nyllcorner 38\ncellsize 0.0003\n1 2\n3 4\n")
                  .find("in degrees"),
              std::string::npos);
    EXPECT_EQ(fault(""), ":1: the header has no `ncols`");
}

TEST_F(HeightGrids, MissingHeightsAreNotANumberUnlessReplaced)
{
    const std::string text =
        "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nnodata_value -99\n1 -99\n3 nan\n";
    EXPECT_TRUE(std::isnan(read(text).height[3]));
    EXPECT_TRUE(std::isnan(read(text).height[1]));
    EXPECT_TRUE(std::isnan(height_at(read(text), 1, 1)));
    EXPECT_EQ(read(text, -2.5).height, (std::vector<double>{3, -2.5, 1, -2.5}));
}

// -9999 stands for no height where the header does not say so, and where it names another mark.
TEST_F(HeightGrids, MarksThatTheHeaderDoesNotNameAreNoCliffs)
{
    const std::string head = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
    for (const char* line : {"", "nodata_value -32768\n"}) {
        const std::string text = head + line + "1 -9999\n3 4\n";
        EXPECT_TRUE(std::isnan(read(text).height[3]));
        EXPECT_EQ(read(text, 0.5).height[3], 0.5);
    }
    for (const char* mark : {"-32768", "-99999", "1e30"}) {
        EXPECT_NE(fault(head + "1 " + mark + "\n3 4\n").find("is impossible for terrain"),
                  std::string::npos);
    }
}

// The triangle surface at a place, by the triangle that is above it: shares nothing with the
// lattice.
double surface_at(const Mesh& mesh, double x, double y)
{
    double highest = -infinity;
    for (const auto& t : mesh.triangles) {
        const auto corner = [&](std::size_t k) {
            return mesh.corners[static_cast<std::size_t>(t[k])];
        };
        const Vec3 a = corner(0);
        const Vec3 u = corner(1) - a;
        const Vec3 v = corner(2) - a;
        const double det = u.x() * v.y() - u.y() * v.x();
        const double s = ((x - a.x()) * v.y() - (y - a.y()) * v.x()) / det;
        const double r = (u.x() * (y - a.y()) - u.y() * (x - a.x())) / det;
        if (det != 0 && s >= -1e-9 && r >= -1e-9 && s + r <= 1 + 1e-9) {
            highest = std::max(highest, a.z() + s * u.z() + r * v.z());
        }
    }
    return highest;
}

TEST_F(HeightGrids, APlaneStaysAPlaneInAnyAxesAndAtAnyResolution)
{
    Dice dice(2);
    for (int k = 0; k < 40; ++k) {
        const double a = dice.between(-0.5, 0.5);
        const double b = dice.between(-0.5, 0.5);
        TerrainPatch patch{.origin = {dice.between(3e5, 4e5), dice.between(4e6, 5e6)},
                           .azimuth_deg = dice.between(-180, 360),
                           .datum = dice.between(-5, 5)};
        const auto ground = [&](double e, double n) {
            return a * (e - patch.origin[0]) + b * (n - patch.origin[1]);
        };
        HeightGrid grid = draw_grid(dice, ground);
        // The grid about the origin: the patch fits in however it is turned.
        const double width = static_cast<double>(grid.columns - 1) * grid.cell[0];
        const double height = static_cast<double>(grid.rows - 1) * grid.cell[1];
        grid.first = {patch.origin[0] - width / 2, patch.origin[1] - height / 2};
        std::size_t row = 0;
        for (double& z : grid.height) {
            z = ground(
                grid.first[0] + static_cast<double>(row % static_cast<std::size_t>(grid.columns)) *
                                    grid.cell[0],
                grid.first[1] + static_cast<double>(row / static_cast<std::size_t>(grid.columns)) *
                                    grid.cell[1]);
            ++row;
        }
        const double reach = std::min(width, height) / 3;
        patch.extent = {-reach * dice.between(0.3, 1), -reach, reach, reach * dice.between(0.3, 1)};
        patch.resolution = dice.between(0.2, 3) * std::min(grid.cell[0], grid.cell[1]);
        patch.bottom = -200;
        const std::vector<double> heights = sample_heights(grid, patch);
        const Mesh mesh = terrain_mesh(patch, heights);
        EXPECT_EQ(closure_fault(mesh), "") << k;
        const double azimuth = patch.azimuth_deg * std::numbers::pi / 180;
        const bool coarser = patch.resolution > std::min(grid.cell[0], grid.cell[1]);
        for (int probe = 0; probe < 5; ++probe) {
            const double inner = coarser ? 0.5 : 1; // means at the rim are of one side
            const double x = inner * dice.between(patch.extent[0], patch.extent[2]);
            const double y = inner * dice.between(patch.extent[1], patch.extent[3]);
            const double east = std::sin(azimuth) * x - std::cos(azimuth) * y;
            const double north = std::cos(azimuth) * x + std::sin(azimuth) * y;
            const double exact = a * east + b * north + patch.datum;
            const double tolerance =
                coarser && patch.resolution > reach / 4 ? patch.resolution : 1e-6;
            EXPECT_NEAR(surface_at(mesh, x, y), exact, tolerance) << k;
        }
    }
}

TEST_F(HeightGrids, TheSolidHasTheVolumeBelowItsHeights)
{
    Dice dice(3);
    for (int k = 0; k < 20; ++k) {
        HeightGrid grid = draw_grid(dice, [&](double, double) { return dice.between(0, 3); });
        TerrainPatch patch{.origin = grid.first, .azimuth_deg = 90.0 * dice.below(4), .bottom = -1};
        patch.resolution = std::min(grid.cell[0], grid.cell[1]) * dice.between(0.3, 1);
        const auto extent = covered_extent(grid, patch);
        ASSERT_TRUE(extent);
        patch.extent = *extent;
        const std::vector<double> heights = sample_heights(grid, patch);
        const Mesh mesh = terrain_mesh(patch, heights);
        ASSERT_EQ(closure_fault(mesh), "");
        // Midpoint rule on a lattice of its own; the triangles differ from it by their creases.
        double sum = 0;
        constexpr int n = 25;
        const double dx = (patch.extent[2] - patch.extent[0]) / n;
        const double dy = (patch.extent[3] - patch.extent[1]) / n;
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                sum += dx * dy *
                       (surface_at(mesh, patch.extent[0] + (i + 0.5) * dx,
                                   patch.extent[1] + (j + 0.5) * dy) -
                        patch.bottom);
            }
        }
        EXPECT_NEAR(solid_properties(mesh).volume, sum, 0.05 * sum) << k;
        EXPECT_GT(solid_properties(mesh).volume, 0);
    }
}

} // namespace
} // namespace hyoryu::test_height_grid
