// SPDX-License-Identifier: MIT
// Still water about a seed: in basins it is the block that fits them, and it stays on its side of
// walls, however they are drawn.
#include "dice.hpp"
#include "own_folder.hpp"

#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/fill.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hyoryu::test_still_water {
namespace {

std::string basin_case(int dimensions, double spacing, const std::string& block,
                       const std::string& walls = {})
{
    return fmt::format(
        "dimensions = {}\n[time]\nend = 1\n[particles]\nspacing = {}\n[fluid]\n"
        "[[fluid.block]]\n{}\n[[wall]]\nshape = \"basin\"\nmin = [0, 0, 0]\nmax = [4, "
        "2, 2]\nopen = [\"+z\"]\n{}",
        dimensions, spacing, block, walls);
}

std::string still(double level, const std::string& seed)
{
    return fmt::format("shape = \"still_water\"\nlevel = {}\nseed = {}\n", level, seed);
}

std::vector<std::array<double, 3>> sorted(const std::vector<Vec3>& points)
{
    std::vector<std::array<double, 3>> places;
    for (const Vec3& p : points) { // to a millionth of a metre: round-off must not sort them
        places.push_back(
            {std::round(p.x() * 1e6), std::round(p.y() * 1e6), std::round(p.z() * 1e6)});
    }
    std::ranges::sort(places);
    return places;
}

std::string fault_of(const std::string& text)
{
    try {
        parse_case(text, "case.toml");
    } catch (const CaseError& error) {
        return error.what();
    }
    return "none";
}

TEST(StillWater, InABasinItIsTheBlockThatFills)
{
    Dice dice(31);
    for (const double spacing : {0.1, 0.05}) {
        for (const int dimensions : {2, 3}) {
            if (dimensions == 3 && spacing < 0.1) {
                continue; // 60,000 particles tell no more
            }
            const double level = spacing * (3 + dice.below(12));
            const std::string seed = dimensions == 2 ? "[1.3]" : "[1.3, 0.7]";
            const Filling box = fill(parse_case(
                basin_case(
                    dimensions, spacing,
                    fmt::format("shape = \"box\"\nmin = [0, 0, 0]\nmax = [4, 2, {}]", level)),
                "case.toml"));
            const Scene scene =
                parse_case(basin_case(dimensions, spacing, still(level, seed)), "case.toml");
            const Filling filling = fill(scene);
            EXPECT_EQ(sorted(filling.fluid), sorted(box.fluid)) << dimensions << " " << spacing;
            EXPECT_TRUE(scene.notices.empty());
            EXPECT_TRUE(filling.warnings.empty());
            for (std::size_t k = 0; k < filling.fluid.size(); ++k) {
                EXPECT_NEAR(filling.fluid_depth[k], level - filling.fluid[k].z(), 1e-9);
            }
        }
    }
}

// A wall across the basin from the floor, or from a gap above it.
TEST(StillWater, AWallHoldsItUnlessThereIsAGap)
{
    Dice dice(32);
    for (int k = 0; k < 12; ++k) {
        const double spacing = k % 2 == 0 ? 0.1 : 0.07;
        const double left = dice.between(1.2, 2);
        const double right = left + dice.between(1, 3) * spacing;
        const bool has_gap = k % 3 == 0;
        const double level = dice.between(0.8, 1.2);
        const bool seed_left = k % 4 < 2;
        const std::string wall =
            fmt::format("[[wall]]\nshape = \"box\"\nmin = [{}, -1, {}]\nmax = [{}, 3, 2]\n", left,
                        has_gap ? 4 * spacing : -0.5, right);
        const Scene scene = parse_case(
            basin_case(2, spacing, still(level, seed_left ? "[0.4]" : "[3.4]"), wall), "case.toml");
        const Filling filling = fill(scene);
        double to_left = 0;
        double to_right = 0;
        for (const Vec3& p : filling.fluid) {
            (p.x() < (left + right) / 2 ? to_left : to_right) += spacing * spacing;
        }
        const double gap = has_gap ? (right - left) * 4 * spacing / 2 : 0;
        // Volumes are right within half a layer at the surface and at the wall.
        const double slack = spacing * 2.5;
        EXPECT_NEAR(to_left, seed_left || has_gap ? left * level + gap : 0,
                    seed_left || has_gap ? slack : 0)
            << k;
        EXPECT_NEAR(to_right, !seed_left || has_gap ? (4 - right) * level + gap : 0,
                    !seed_left || has_gap ? slack : 0)
            << k;
    }
}

TEST(StillWater, ACourtyardIsDryUnlessTheSeedIsInIt)
{
    const std::string house =
        "[[wall]]\nname = \"house\"\nshape = \"prism\"\nbottom = -0.5\ntop = 1.5\n"
        "corners = [[1, 0.4, 0], [3, 0.4, 0], [3, 1.6, 0], [1, 1.6, 0], [1, "
        "0.4, 0], [1.4, 0.7, 0], [1.4, 1.3, 0], [2.6, 1.3, 0], [2.6, 0.7, 0], "
        "[1.4, 0.7, 0]]\n";
    const auto inside = [](const Vec3& p) {
        return p.x() > 1 && p.x() < 3 && p.y() > 0.4 && p.y() < 1.6;
    };
    for (const double spacing : {0.1, 0.08}) {
        const Filling street =
            fill(parse_case(basin_case(3, spacing, still(1, "[0.5, 1.0]"), house), "case.toml"));
        EXPECT_EQ(std::ranges::count_if(street.fluid, inside), 0);
        const double cube = std::pow(spacing, 3);
        EXPECT_NEAR(static_cast<double>(street.fluid.size()) * cube, 8 - 2 * 1.2, 0.3);
        const Filling yard =
            fill(parse_case(basin_case(3, spacing, still(1, "[2.0, 1.0]"), house), "case.toml"));
        EXPECT_EQ(std::ranges::count_if(yard.fluid, inside), std::ssize(yard.fluid));
        EXPECT_NEAR(static_cast<double>(yard.fluid.size()) * cube, 1.2 * 0.6, 0.12);
    }
}

// Two hollows and a ridge of 0.2 m between them: a lower level fills one of them.
TEST(StillWater, OnTerrainItFillsTheHollowOfTheSeed)
{
    const auto ground = [](double x) { return 0.2 * std::cos(3.14159265358979 * x); };
    const OwnFolder folder;
    std::string grid = "ncols 121\nnrows 31\nxllcenter -1\nyllcenter -0.25\ncellsize 0.05\n";
    for (int j = 0; j < 31; ++j) {
        for (int i = 0; i < 121; ++i) {
            grid += fmt::format("{} ", ground(-1 + 0.05 * i));
        }
        grid += '\n';
    }
    folder.put("ground.asc", grid);
    const std::string walls =
        "[[wall]]\nname = \"ground\"\nshape = \"terrain\"\nfile = \"ground.asc\"\n"
        "origin = [0.0, 0.0]\nextent = [-0.2, -0.2, 4.2, 1.2]\nresolution = "
        "0.05\n[[wall]]\nname = \"sides\"\nshape = \"basin\"\nmin = [0, 0, -1]\n"
        "max = [4, 1, 1]\nopen = [\"+z\", \"-z\"]\n";
    for (const double spacing : {0.05, 0.04}) {
        for (const double level : {0.0, 0.1, 0.3}) {
            const Scene scene =
                parse_case(fmt::format("[time]\nend = 1\n[particles]\nspacing = {}\n[fluid]\n"
                                       "[[fluid.block]]\n{}{}",
                                       spacing, still(level, "[1.0, 0.5]"), walls),
                           folder / "case.toml");
            const Filling filling = fill(scene);
            double expected = 0; // by the midpoint rule
            for (int n = 0; n < 4000; ++n) {
                const double x = (n + 0.5) / 1000;
                const bool reached = level > 0.2 || x < 2;
                expected += reached ? std::max(level - ground(x), 0.0) / 1000 : 0;
            }
            // Columns are rounded to whole particles; those at the shore are below half of one.
            EXPECT_NEAR(static_cast<double>(filling.fluid.size()) * std::pow(spacing, 3), expected,
                        0.04 * expected)
                << spacing << " " << level;
            EXPECT_TRUE(level > 0.2 || std::ranges::none_of(
                                           filling.fluid, [](const Vec3& p) { return p.x() > 2; }));
            EXPECT_TRUE(std::ranges::none_of(filling.fluid, [&](const Vec3& p) {
                return p.z() < ground(p.x()) || p.z() > level;
            }));
            EXPECT_TRUE(scene.notices.empty());
        }
    }
}

TEST(StillWater, AResolvedCaseHasTheSameWater)
{
    const std::string wall = "[[wall]]\nshape = \"box\"\nmin = [1.7, -1, -0.5]\nmax = [2, 3, 2]\n";
    for (const int dimensions : {2, 3}) {
        const Scene scene =
            parse_case(basin_case(dimensions, 0.1,
                                  still(0.93, dimensions == 2 ? "[0.4]" : "[0.4, 0.5]"), wall),
                       "case.toml");
        const std::string resolved = to_toml(scene);
        const Scene again = parse_case(resolved, "case.toml");
        EXPECT_EQ(to_toml(again), resolved);
        EXPECT_EQ(fill(again).fluid, fill(scene).fluid);
    }
}

TEST(StillWater, MistakesAreTold)
{
    const auto told = [](int dimensions, const std::string& block, const std::string& walls = {}) {
        return fault_of(basin_case(dimensions, 0.1, block, walls));
    };
    EXPECT_EQ(told(3, still(1, "[1, 1]")), "none");
    EXPECT_NE(told(3, still(1, "[1]")).find("expected [x, y], found 1 numbers"), std::string::npos);
    EXPECT_NE(told(2, still(1, "[1, 1]")).find("expected [x] in two"), std::string::npos);
    EXPECT_NE(told(3, still(1, "[9, 1]")).find("outside of the scene"), std::string::npos);
    EXPECT_NE(told(3, still(-1, "[1, 1]")).find("below all walls"), std::string::npos);
    EXPECT_NE(told(3, "shape = \"still_water\"\nlevel = 1.0").find("seed`: is missing"),
              std::string::npos);
    EXPECT_NE(told(3, still(1, "[1, 1]") + "radius = 3.0").find("radius"), std::string::npos);
    EXPECT_NE(told(3, still(1, "[1, 1]"),
                   "[[wall]]\nshape = \"box\"\nmin = [0.5, 0.5, 0]\nmax = [1.5, "
                   "1.5, 2]\n")
                  .find("is inside a wall"),
              std::string::npos);
    EXPECT_NE(told(3, still(1, "[1, 1]") + "[[fluid.block]]\n" + still(0.8, "[3, 1]"))
                  .find("is connected with still water"),
              std::string::npos);
    EXPECT_NE(fault_of("gravity = [0, 1, -9]\n" + basin_case(3, 0.1, still(1, "[1, 1]")))
                  .find("needs gravity along -z"),
              std::string::npos);
    const std::string open = basin_case(3, 0.1, still(1, "[1, 1]"));
    const std::size_t at = open.find("[\"+z\"]");
    const Scene scene =
        parse_case(open.substr(0, at) + "[\"+z\", \"+x\"]" + open.substr(at + 6), "case.toml");
    ASSERT_EQ(scene.notices.size(), 1u);
    EXPECT_NE(scene.notices[0].what.find("reaches the edge of the scene at (3.95"),
              std::string::npos)
        << scene.notices[0].what;
}

// A window lets water pass; a gap beside it is told of all the same.
TEST(StillWater, AGapBesideAWindowIsToldOf)
{
    const auto notices = [](const std::string& open, const std::string& wall) {
        const std::string text =
            basin_case(3, 0.1, still(1, "[1, 1]")) +
            "[[open]]\nname = \"sea\"\nmin = [0, 0, 0]\nmax = [0, 2, 2]\ninto = \"+x\"\nkind = "
            "\"absorb\"\n" +
            wall;
        const std::size_t at = text.find("[\"+z\"]");
        return parse_case(text.substr(0, at) + open + text.substr(at + 6), "case.toml").notices;
    };
    EXPECT_TRUE(notices("[\"+z\", \"-x\"]", "").empty());
    const auto told = notices("[\"+z\", \"-x\", \"+x\"]", "");
    ASSERT_EQ(told.size(), 1U);
    EXPECT_NE(told[0].what.find("reaches the edge of the scene at (3.95"), std::string::npos);
    EXPECT_TRUE(notices("[\"+z\", \"-x\", \"+x\"]",
                        "[[wall]]\nshape = \"box\"\nmin = [3.5, -1, -1]\nmax = [4, 3, 2]\n")
                    .empty());
}

} // namespace
} // namespace hyoryu::test_still_water
