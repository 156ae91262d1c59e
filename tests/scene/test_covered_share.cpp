// SPDX-License-Identifier: MIT
// What moving walls leave of a cell of a fixed one, against places that are drawn in the cell; and
// moving walls whose surface is that of a fixed wall.
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/covered_share.hpp"
#include "hyoryu/scene/plan.hpp"

#include "dice.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace hyoryu::test_covered_share {
namespace {

constexpr double edge = 0.1;
constexpr double close = 0.06; // a ninth of the cell at the corner of a box is cut by one plane

Scene scene_of(const std::string& walls, const std::string& domain = "")
{
    return parse_case("[time]\nend = 1\n[particles]\nspacing = 0.1\n[fluid]\n[[fluid.block]]\n"
                      "shape = \"box\"\nmin = [0, 0, 0]\nmax = [4, 1, 1]\n" +
                          domain + walls,
                      "case.toml");
}

std::string box(const Vec3& min, const Vec3& max)
{
    return fmt::format("[[wall]]\nshape = \"box\"\nmin = [{}, {}, {}]\nmax = [{}, {}, {}]\n",
                       min.x(), min.y(), min.z(), max.x(), max.y(), max.z());
}

double share_of(const Scene& scene, const Vec3& place)
{
    std::vector<SolidSurface> surfaces;
    for (const Wall& wall : scene.walls) {
        surfaces.push_back(surface_of(wall, 1, 3));
    }
    std::vector<CoverWall> covers;
    for (const SolidSurface& solid : surfaces) {
        covers.push_back({&solid, solid.centre});
    }
    return uncovered_share(covers, place, edge, periods_of(scene));
}

double sampled(const Vec3& place, const std::function<bool(const Vec3&)>& in_wall)
{
    constexpr int n = 20;
    int outside = 0;
    for (int k = 0; k < n * n * n; ++k) {
        const int layer = k / (n * n);
        const Vec3 cell(k % n, k / n % n, layer);
        outside += in_wall(place + edge * ((cell.array() + 0.5) / n - 0.5).matrix()) ? 0 : 1;
    }
    return static_cast<double>(outside) / (n * n * n);
}

// Two boxes of one floor, coincident floors, a floor and a side, a floor across a periodic side.
TEST(CoveredShare, IsThatOfPlacesDrawnInTheCell)
{
    Dice dice(5);
    for (int draw = 0; draw < 100; ++draw) {
        const double seam = dice.between(1.9, 2.1);
        const double other = dice.between(-0.1, 0.1); // a step of the floor, or its top
        const Vec3 place{dice.between(1.9, 2.1), 0.5, dice.between(-0.12, 0.12)};
        const std::string left = box({-1, -1, -1}, {seam, 2, 0});
        const std::string right = box({seam, -1, -1}, {5, 2, 0});
        const Scene floor = scene_of(left + right);
        EXPECT_NEAR(share_of(floor, place), sampled(place, [](const Vec3& p) { return p.z() < 0; }),
                    close)
            << "seam " << seam << ", place " << place.transpose();
        const Scene twice = scene_of("[[wall]]\nshape = \"plane\"\n" + left + right);
        EXPECT_NEAR(share_of(twice, place), share_of(floor, place), close);
        const Scene lower =
            scene_of(box({-1, -1, -1}, {5, 2, 0}) + box({-1, -1, -1}, {5, 2, other}));
        EXPECT_NEAR(share_of(lower, place),
                    sampled(place, [&](const Vec3& p) { return p.z() < std::max(0.0, other); }),
                    close);
        const Scene corner =
            scene_of("[[wall]]\nshape = \"plane\"\n" + box({seam, -1, -1}, {5, 2, 3}));
        EXPECT_NEAR(share_of(corner, place),
                    sampled(place, [&](const Vec3& p) { return p.z() < 0 || p.x() > seam; }),
                    close);
    }
}

TEST(CoveredShare, HoldsForImagesInPeriodicDomains)
{
    Dice dice(6);
    const Scene scene =
        scene_of(box({0, -1, -1}, {4, 2, 0}),
                 "[domain]\nmin = [0, 0, -1]\nmax = [4, 1, 2]\nperiodic = [\"x\"]\n");
    for (int draw = 0; draw < 100; ++draw) {
        const Vec3 place{dice.between(-0.1, 0.1) + 4 * (dice.below(7) - 3), 0.5,
                         dice.between(-0.12, 0.12)};
        EXPECT_NEAR(share_of(scene, place), std::clamp(0.5 + place.z() / edge, 0.0, 1.0), close)
            << place.transpose();
    }
}

// Any number of walls may meet in a cell: many slabs within a floor, told before it, change
// nothing.
TEST(CoveredShare, DoesNotDependOnTheNumberOfWallsInACell)
{
    Dice dice(7);
    const std::string floor = box({-1, -1, -1}, {5, 2, 0});
    for (int draw = 0; draw < 20; ++draw) {
        std::string slabs;
        for (int k = 20 + dice.below(20); k > 0; --k) {
            slabs += box({-1, -1, -1}, {5, 2, -dice.between(0.02, 0.04)});
        }
        const Vec3 place{dice.between(1, 3), 0.5, dice.between(-0.04, 0.04)};
        EXPECT_NEAR(share_of(scene_of(slabs + floor), place), 0.5 + place.z() / edge, close)
            << place.transpose();
    }
}

std::vector<std::string> told_of(const std::string& sides, const std::string& wall)
{
    const Scene scene = parse_case(
        "dimensions = 2\n[time]\nend = 1\n[particles]\nspacing = 0.05\n[fluid]\n[[fluid.block]]\n"
        "shape = \"box\"\nmin = [0, 0, 0]\nmax = [1, 0, 0.9]\n[[wall]]\nname = \"tank\"\n"
        "shape = \"basin\"\nmin = [0, 0, 0]\nmax = [1, 0, 1]\n" +
            sides + wall,
        "case.toml");
    std::vector<std::string> said;
    for (const Diagnostic& warning : make_plan(scene, fill(scene)).warnings) {
        if (warning.what.find("alone acts on the water") != std::string::npos) {
            said.push_back(warning.what);
        }
    }
    return said;
}

std::string moving(const std::string& min, const std::string& max, const std::string& motion)
{
    return "[[wall]]\nname = \"lid\"\nshape = \"box\"\nmin = " + min + "\nmax = " + max +
           "\n[wall.motion]\n" + motion + "\n";
}

TEST(CoveredShare, ALidInAClosedSideIsToldOfAndOthersAreNot)
{
    const std::string along = "velocity = [1, 0, 0]";
    const std::string lid = moving("[-2, 0, 1]", "[2, 0, 1.2]", along);
    EXPECT_EQ(told_of("", lid).size(), 1u);
    EXPECT_TRUE(told_of("open = [\"+z\"]\n", lid).empty());
    const std::string piston = moving("[-0.2, 0, 0]", "[0, 0, 1]", along);
    EXPECT_TRUE(told_of("open = [\"+z\"]\n", piston).empty()) << "it comes out of the side";
    const std::string gate = moving("[0.5, 0, 0]", "[0.7, 0, 1]", "velocity = [0, 0, 1]");
    EXPECT_TRUE(told_of("open = [\"+z\"]\n", gate).empty()) << "it stands on the floor";
    const std::string bed = moving("[0.2, 0, -0.2]", "[0.6, 0, 0]", "velocity = [0.1, 0, 0]");
    EXPECT_EQ(told_of("open = [\"+z\"]\n", bed).size(), 1u) << "it slides in the floor";
}

} // namespace
} // namespace hyoryu::test_covered_share
