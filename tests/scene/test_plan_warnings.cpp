// SPDX-License-Identifier: MIT
// What the plan warns of, and what it has no reason to.
#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/plan.hpp"

#include "own_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace hyoryu::test_plan_warnings {
namespace {

// A plank of two spacings, and of less than a third of the density of water: on end it would tip.
const std::string plank = R"(
dimensions = 2
[time]
end = 1.0
[particles]
spacing = 0.05
[[wall]]
shape = "plane"
[[body]]
shape = "box"
size = [0.1, 1.0, 1.0]
density = 300
position = [0, 0, 1]
)";

bool warns(const std::string& text, const std::string& words)
{
    const Scene scene = parse_case(text, "case.toml");
    const Plan plan = make_plan(scene, fill(scene));
    return std::ranges::any_of(plan.warnings, [&](const Diagnostic& warning) {
        return warning.what.find(words) != std::string::npos;
    });
}

TEST(PlanWarnings, OfThinAndTippingBodiesAreForWaterOnly)
{
    const std::string water = "[fluid]\n[[fluid.block]]\nshape = \"box\"\nmin = [1, 0, 0]\n"
                              "max = [2, 0, 0.5]\n";
    for (const char* words : {"less than 3 spacings", "will not float upright"}) {
        EXPECT_TRUE(warns(plank + water, words)) << words;
        EXPECT_FALSE(warns(plank, words)) << words << " in a scene without water";
    }
}

// A paddle between upright sides, its foot at a height over the floor.
std::string paddle(double foot, const std::string& motion)
{
    return fmt::format("[time]\nend = 1.0\n[particles]\nspacing = 0.05\n[fluid]\n[[fluid.block]]\n"
                       "shape = \"box\"\nmin = [0.5, 0, 0]\nmax = [2, 0.4, 0.5]\n[[wall]]\n"
                       "name = \"flume\"\nshape = \"basin\"\nmin = [0, 0, 0]\n"
                       "max = [2, 0.4, 1]\nopen = [\"+z\"]\n[[wall]]\nname = \"paddle\"\n"
                       "shape = \"box\"\nmin = [0.3, 0.0, {}]\nmax = [0.5, 0.4, 1.0]\n{}",
                       foot, motion);
}

TEST(PlanWarnings, OfAGapThroughWhichAPaddleLeaks)
{
    const std::string moves = "motion.velocity = [0.1, 0, 0]\n";
    const std::string words = "\"paddle\" moves and leaves a gap";
    EXPECT_TRUE(warns(paddle(0.05, moves), words));
    EXPECT_TRUE(warns(paddle(0.1, moves), words));
    EXPECT_FALSE(warns(paddle(0.02, moves), words)) << "no particle fits in";
    EXPECT_FALSE(warns(paddle(0, moves), words));
    EXPECT_FALSE(warns(paddle(0.4, moves), words)) << "meant";
    EXPECT_FALSE(warns(paddle(0.05, ""), words)) << "it stands still";
}

// E11: a tank with a crate, and one slip at a time.
TEST(PlanWarnings, OfWhatIsProbablyASlip)
{
    const std::string tank = "gravity = [0.0, 0.0, -9.81]\n[time]\nend = 1.0\n[particles]\n"
                             "spacing = 0.1\n[domain]\nmin = [-0.3, -0.3, -0.3]\n"
                             "max = [2.3, 1.3, 2.3]\n[fluid]\ndensity = 1000\n"
                             "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\n"
                             "max = [1, 1, 0.5]\n[[wall]]\nname = \"tank\"\nshape = \"basin\"\n"
                             "min = [0, 0, 0]\nmax = [2, 1, 2]\nopen = [\"+z\"]\n[[wall]]\n"
                             "name = \"gate\"\nshape = \"box\"\nmin = [1.0, 0, 0]\n"
                             "max = [1.2, 1, 1]\n[[body]]\nname = \"crate\"\nshape = \"box\"\n"
                             "size = [0.3, 0.3, 0.3]\ndensity = 500\nposition = [1.6, 0.5, 0.2]\n";
    struct Slip {
        std::string from, to, words;
    };
    const std::vector<Slip> slips = {
        {"density = 500", "density = 0.5", "0.5 kg/m3 is lower than"},
        {"density = 1000", "density = 1.0", "1 kg/m3 is lower than"},
        {"-9.81", "9.81", "points upward"},
        {"[domain]\nmin = [-0.3, -0.3, -0.3]\nmax = [2.3, 1.3, 2.3]\n", "", ""},
        {"[1.0, 0, 0]\nmax = [1.2", "[1.1, 0, 0]\nmax = [1.15", "\"gate\" is 0.05 m thick"},
        {"max = [2.3, 1.3, 2.3]", "max = [1.5, 1.3, 2.3]", "a closed side of wall \"tank\""},
        {"max = [2.3, 1.3, 2.3]", "max = [0.6, 1.3, 2.3]", "`fluid.block[0]` reaches beyond"},
        {"max = [2.3, 1.3, 2.3]", "max = [2.3, 1.3, 0.2]", "the domain ends within"},
        {"position = [1.6, 0.5, 0.2]", "position = [1.6, 0.5, 220]", "from the rest of the scene"}};
    const auto count = [](const std::string& text) {
        const Scene scene = parse_case(text, "case.toml");
        return make_plan(scene, fill(scene)).warnings.size();
    };
    const std::size_t before = count(tank);
    for (const Slip& slip : slips) {
        std::string text = tank;
        text.replace(text.find(slip.from), slip.from.size(), slip.to);
        if (slip.words.empty()) {
            EXPECT_EQ(count(text), before) << "nothing is wrong without " << slip.from;
        } else {
            EXPECT_FALSE(warns(tank, slip.words)) << slip.words;
            EXPECT_TRUE(warns(text, slip.words)) << slip.words;
        }
    }
}

// A body of three by three by three particles, farther apart or nearer than their cells.
TEST(PlanWarnings, OfParticlesThatOverlapOrAreCoarserThanTheFluid)
{
    const OwnFolder folder;
    for (const double distance : {0.04, 0.09, 0.1, 0.13}) {
        std::string points;
        for (int k = 0; k < 27; ++k) {
            const int row = k / 3;
            points +=
                fmt::format("{} {} {}\n", k % 3 * distance, row % 3 * distance, row / 3 * distance);
        }
        const std::filesystem::path file = folder.put("points.txt", points);
        const std::string text = fmt::format(
            "[time]\nend = 1.0\n[particles]\nspacing = 0.1\n[fluid]\n[[fluid.block]]\n"
            "shape = \"box\"\nmin = [2, 0, 0]\nmax = [3, 1, 0.5]\n[[wall]]\nshape = \"plane\"\n"
            "[[body]]\nname = \"b\"\nshape = \"particles\"\nfile = \"{}\"\n"
            "density = 500\nposition = [0, 0, 1]\n",
            file.string());
        EXPECT_EQ(warns(text, "of their volume: volume, mass and draft"), distance < 0.1);
        EXPECT_FALSE(warns(text, "floats too deep"));
        EXPECT_TRUE(warns(text + "spacing = 0.13\n", "floats too deep"));
    }
}

// A point gauge reaches through a wall that is thinner than the kernel; a face does not.
TEST(PlanWarnings, OfGaugesThatReadTheOtherSideOfAWall)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> of_spacings(0.1, 4);
    for (int n = 0; n < 40; ++n) {
        const double dp = n % 2 == 0 ? 0.1 : 0.04;
        const double thick = of_spacings(random) * dp;
        const double away = of_spacings(random) * dp;
        const std::string text = fmt::format(
            "[time]\nend = 1.0\n[particles]\nspacing = {}\n[fluid]\n[[fluid.block]]\n"
            "shape = \"box\"\nmin = [0, 0, 0]\nmax = [0.4, 0.4, 0.2]\n[[wall]]\nshape = \"basin\"\n"
            "min = [0, 0, 0]\nmax = [3, 1, 1]\nopen = [\"+z\"]\n[[wall]]\nname = \"sheet\"\n"
            "shape = \"box\"\nmin = [1, 0, 0]\nmax = [{}, 1, 1]\n[[gauge]]\n"
            "type = \"pressure\"\nat = [{}, 0.5, 0.2]\n",
            dp, 1 + thick, 1 + thick + away);
        const std::string words = "also reads water behind the wall \"sheet\"";
        EXPECT_EQ(warns(text, words), thick + away < 3 * dp) << text;
        EXPECT_FALSE(warns(text + "normal = [1, 0, 0]\narea = 0.01\n", words));
    }
}

TEST(PlanErrors, AFluxThroughAPlaneOutsideTheDomain)
{
    const auto faults = [](const std::string& at, const std::string& normal) {
        const std::string text =
            "[time]\nend = 1.0\n[particles]\nspacing = 0.1\n[domain]\nmin = [0, 0, 0]\n"
            "max = [3, 1, 2]\n[fluid]\n[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\n"
            "max = [1, 1, 0.5]\n[[gauge]]\ntype = \"flux\"\nat = " +
            at + "\nnormal = " + normal + "\n";
        const Scene scene = parse_case(text, "case.toml");
        try {
            make_plan(scene, fill(scene));
        } catch (const CaseError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(faults("[2.9, 9, 9]", "[1, 0, 0]"), "") << "any point of the plane";
    EXPECT_EQ(faults("[4, 0, 0]", "[1, 0, 1]"), "") << "askew through a corner";
    EXPECT_NE(faults("[3.1, 0.5, 0]", "[-2, 0, 0]").find("outside the domain"), std::string::npos);
    EXPECT_NE(faults("[6, 0, 0]", "[1, 0, 1]").find("outside the domain"), std::string::npos);
}

// Water over a slab that lies askew to the lattice, a square of a side.
std::string water_over_slab(double turn, double angle, double dp, double side)
{
    return fmt::format(
        "[time]\nend = 1.0\n[particles]\nspacing = {}\n[fluid]\n[[fluid.block]]\n"
        "shape = \"box\"\nmin = [-0.6, -0.6, -0.6]\nmax = [0.6, 0.6, 0.5]\n[[wall]]\n"
        "name = \"slab\"\nshape = \"box\"\nsize = [{}, {}, 1.6]\n"
        "position = [0, 0, -0.8]\n[wall.rotation_deg]\naxis = [0.3, 1, {}]\n"
        "angle = {}\n",
        dp, side, side, turn, angle);
}

TEST(PlanWarnings, OfLeaksAreOfWaterWithoutABedAndOfNoneOverABedAskew)
{
    const std::string words = "have no wall below them";
    for (int k = 0; k < 12; ++k) {
        const double turn = 0.4 * k;
        const double angle = 1.9 * k;
        const double dp = k % 2 == 0 ? 0.1 : 0.13;
        EXPECT_FALSE(warns(water_over_slab(turn, angle, dp, 3), words)) << turn << ", " << angle;
        EXPECT_TRUE(warns(water_over_slab(turn, angle, dp, 0.5), words)) << turn << ", " << angle;
    }
}

// A box in a tank of water 1 m deep, its middle at a height.
std::string box_in_water(double z, double density, const std::string& keys)
{
    return fmt::format("[time]\nend = 1.0\n[particles]\nspacing = 0.1\n[fluid]\n[[fluid.block]]\n"
                       "shape = \"box\"\nmin = [0, 0, 0]\nmax = [2, 2, 1]\n[[wall]]\n"
                       "shape = \"basin\"\nmin = [0, 0, 0]\nmax = [2, 2, 3]\nopen = [\"+z\"]\n"
                       "[[body]]\nname = \"box\"\nshape = \"box\"\nsize = [0.4, 0.4, 0.4]\n"
                       "density = {}\nposition = [1, 1, {}]\n{}",
                       density, z, keys);
}

TEST(PlanWarnings, OfLightBodiesUnderWater)
{
    EXPECT_TRUE(warns(box_in_water(0.2, 300, ""), "starts under 0.6 m of water"));
    EXPECT_TRUE(warns(box_in_water(0.6, 900, ""), "starts under 0.2 m of water"));
    EXPECT_FALSE(warns(box_in_water(0.95, 500, ""), "starts under")) << "it floats";
    EXPECT_FALSE(warns(box_in_water(1.6, 500, ""), "starts under")) << "it falls in";
    EXPECT_FALSE(warns(box_in_water(0.2, 1200, ""), "starts under")) << "it lies";
    EXPECT_FALSE(warns(box_in_water(0.2, 300, "fixed = true\n"), "starts under"));
}

} // namespace
} // namespace hyoryu::test_plan_warnings
