// SPDX-License-Identifier: MIT
// Warnings of water and bodies that nothing holds, in tanks drawn at random with one side open.
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/plan.hpp"

#include "dice.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hyoryu::test_plan_leaks {
namespace {

constexpr std::array sides{"-x", "+x", "-y", "+y"};

// A tank whose side lies anywhere on the lattice, with water up to a distance from each side.
struct Tank {
    int dimensions = 3;
    double dp = 0.05;
    Vec3 low{0, 0, 0}, high{0, 0, 0};
    std::string open;              // sides without a wall
    std::array<double, 4> clear{}; // of water at -x, +x, -y, +y [m]
    std::string more;              // of the case
    double top = 1;                // of the sides [m]

    std::string text() const
    {
        const bool flat = dimensions == 2;
        return fmt::format(
            "dimensions = {}\n[time]\nend = 1\n[particles]\nspacing = {}\n[fluid]\n"
            "[[fluid.block]]\nshape = \"box\"\nmin = [{}, {}, 0]\nmax = [{}, {}, 0.3]\n[[wall]]\n"
            "name = \"tank\"\nshape = \"basin\"\nmin = [{}, {}, 0]\nmax = [{}, {}, {}]\n"
            "open = [\"+z\"{}]\n{}",
            dimensions, dp, low.x() + clear[0], flat ? 0 : low.y() + clear[2], high.x() - clear[1],
            flat ? 0 : high.y() - clear[3], low.x(), flat ? 0 : low.y(), high.x(),
            flat ? 0 : high.y(), top, open, more);
    }
};

Tank drawn(Dice& dice, int dimensions)
{
    Tank tank{.dimensions = dimensions, .dp = dice.chance(0.5) ? 0.05 : 0.07};
    tank.low = Vec3{dice.between(-1, 1), dice.between(-1, 1), 0};
    tank.high = tank.low + Vec3{dice.between(0.6, 1.2), dice.between(0.5, 0.9), 0};
    return tank;
}

std::vector<std::string> warnings_of(const std::string& text)
{
    const Scene scene = parse_case(text, "case.toml");
    std::vector<std::string> said;
    for (const Diagnostic& warning : make_plan(scene, fill(scene)).warnings) {
        said.push_back(warning.what);
    }
    return said;
}

bool warns(const std::string& text, const std::string& words)
{
    return std::ranges::any_of(warnings_of(text), [&](const std::string& what) {
        return what.find(words) != std::string::npos;
    });
}

const std::string drop = "water can reach the edge of the ground";

TEST(PlanLeaks, WaterAtAnOpenSideIsToldWithItsDirection)
{
    Dice dice(71);
    for (int n = 0; n < number_from("HYORYU_DRAWS", 32); ++n) {
        const int dimensions = n % 4 == 0 ? 2 : 3;
        Tank tank = drawn(dice, dimensions);
        const int side = dice.below(dimensions == 2 ? 2 : 4);
        EXPECT_FALSE(warns(tank.text(), drop)) << "closed\n" << tank.text();
        tank.open = fmt::format(", \"{}\"", sides[static_cast<std::size_t>(side)]);
        EXPECT_TRUE(warns(
            tank.text(), fmt::format("in direction {} and", sides[static_cast<std::size_t>(side)])))
            << tank.text();
        EXPECT_EQ(std::ranges::count_if(
                      warnings_of(tank.text()),
                      [](const std::string& what) { return what.find(drop) != std::string::npos; }),
                  1)
            << tank.text();
    }
}

// A roof over the place beyond a floor is no ground.
TEST(PlanLeaks, WaterThatFallsBelowARoofIsTold)
{
    Dice dice(80);
    for (int n = 0; n < number_from("HYORYU_DRAWS", 12); ++n) {
        Tank tank = drawn(dice, n % 3 == 0 ? 2 : 3);
        const bool flat = tank.dimensions == 2;
        tank.open = ", \"-x\"";
        const double low = dice.between(0.35, 0.7);
        const std::array beyond{dice.between(0.5, 2), dice.between(0, 0.3)};
        tank.more = fmt::format(
            "[[wall]]\nname = \"roof\"\nshape = \"box\"\nmin = [{}, {}, {}]\nmax = [{}, {}, {}]\n",
            tank.low.x() - beyond[0], flat ? 0 : tank.low.y() - 1, low, tank.low.x() + beyond[1],
            flat ? 0 : tank.high.y() + 1, low + dice.between(0.1, 0.3));
        EXPECT_TRUE(warns(tank.text(), drop)) << tank.text();
        tank.open.clear();
        EXPECT_FALSE(warns(tank.text(), drop)) << tank.text();
    }
}

TEST(PlanLeaks, WaterThatIsHeldIsNot)
{
    Dice dice(72);
    for (int n = 0; n < number_from("HYORYU_DRAWS", 16); ++n) {
        Tank tank = drawn(dice, 3);
        const int side = dice.below(4);
        tank.open = fmt::format(", \"{}\"", sides[static_cast<std::size_t>(side)]);
        Tank away = tank; // a column that breaks has floor beside it, but that ends
        away.clear[static_cast<std::size_t>(side)] = dice.between(1, 5) * tank.dp;
        EXPECT_TRUE(warns(away.text(), drop)) << away.text();
        Tank ground = tank; // a plane ends where the domain does, at the tank here
        ground.more = "[[wall]]\nname = \"ground\"\nshape = \"plane\"\n";
        EXPECT_TRUE(warns(ground.text(), drop)) << ground.text();
        Tank shut = tank; // a thick wall of its own
        const int axis = side / 2;
        const double plane = side % 2 == 0 ? tank.low[axis] : tank.high[axis];
        const double wide = 3 * tank.dp;
        Vec3 from(tank.low.x() - 1, tank.low.y() - 1, -0.2);
        Vec3 to(tank.high.x() + 1, tank.high.y() + 1, 1);
        from[axis] = side % 2 == 0 ? plane - wide : plane;
        to[axis] = from[axis] + wide;
        shut.more = fmt::format("[[wall]]\nname = \"gate\"\nshape = \"box\"\nmin = [{}, {}, {}]\n"
                                "max = [{}, {}, {}]\n",
                                from.x(), from.y(), from.z(), to.x(), to.y(), to.z());
        EXPECT_FALSE(warns(shut.text(), drop)) << shut.text();
    }
}

// A gate on a floor that goes on for a while beyond it, and ends.
TEST(PlanLeaks, WaterThatPassesBelowAGateIsTold)
{
    Dice dice(77);
    for (int n = 0; n < number_from("HYORYU_DRAWS", 16); ++n) {
        Tank tank = drawn(dice, n % 4 == 0 ? 2 : 3);
        const bool flat = tank.dimensions == 2;
        tank.open = ", \"+x\"";
        const double gate = tank.high.x() - dice.between(0.1, 0.3); // its face towards the water
        tank.clear[1] = tank.high.x() - gate;
        const auto over = [&](double gap) {
            Tank with = tank;
            with.more = fmt::format(
                "[[wall]]\nname = \"gate\"\nshape = \"box\"\nmin = [{}, {}, {}]\nmax = [{}, {}, "
                "1]\n",
                gate, flat ? 0 : tank.low.y() - 1, gap, gate + dice.between(1.1, 3) * tank.dp,
                flat ? 0 : tank.high.y() + 1);
            return with.text();
        };
        const std::string shut = over(dice.between(-0.1, 0));
        EXPECT_FALSE(warns(shut, drop)) << shut;
        const std::string lifted = over(dice.between(2.1, 3) * tank.dp);
        EXPECT_TRUE(warns(lifted, drop)) << lifted;
    }
}

// A gate that is lifted, on a floor that ends beyond it or has a wall there.
TEST(PlanLeaks, WaterThatPassesAGateOnceItHasRisenIsTold)
{
    const std::string risen = "once \"gate\" has risen";
    Dice dice(80);
    for (int n = 0; n < number_from("HYORYU_DRAWS", 16); ++n) {
        Tank tank = drawn(dice, n % 4 == 0 ? 2 : 3);
        const bool flat = tank.dimensions == 2;
        const double gate = tank.high.x() - dice.between(0.1, 0.3);
        tank.clear[1] = tank.high.x() - gate;
        const auto with_motion = [&](const std::string& motion, bool shut) {
            Tank with = tank;
            with.open = shut ? "" : ", \"+x\"";
            with.more = fmt::format(
                "[[wall]]\nname = \"gate\"\nshape = \"box\"\nmin = [{}, {}, -0.01]\nmax = [{}, {}, "
                "1]\n[wall.motion]\n{}\n",
                gate, flat ? 0 : tank.low.y() - 1, gate + dice.between(1.1, 2) * tank.dp,
                flat ? 0 : tank.high.y() + 1, motion);
            return with.text();
        };
        const std::string lift = "lift = { speed = 1.5 }";
        EXPECT_TRUE(warns(with_motion(lift, false), risen)) << with_motion(lift, false);
        EXPECT_FALSE(warns(with_motion(lift, true), drop)) << with_motion(lift, true);
        const std::string aside = "velocity = [0.01, 0, 0]";
        EXPECT_FALSE(warns(with_motion(aside, false), drop)) << with_motion(aside, false);
    }
}

// Of two gates in a tank that is open at one end only that at this end lets water out.
TEST(PlanLeaks, TheGateThatLetsWaterOutIsNamed)
{
    Dice dice(81);
    for (int n = 0; n < number_from("HYORYU_DRAWS", 8); ++n) {
        Tank tank = drawn(dice, 2);
        tank.clear[0] = dice.between(0.1, 0.2);
        tank.clear[1] = dice.between(0.1, 0.2);
        tank.open = ", \"+x\"";
        const auto gate = [&](const std::string& name, double from) {
            return fmt::format(
                "[[wall]]\nname = \"{}\"\nshape = \"box\"\nmin = [{}, 0, -0.01]\nmax "
                "= [{}, 0, 1]\n[wall.motion]\nvelocity = [0, 0, {}]\n",
                name, from, from + 0.08, dice.between(0.7, 3) * tank.dp);
        };
        tank.more = gate("shut", tank.low.x() + tank.clear[0] - 0.08) +
                    gate("leads out", tank.high.x() - tank.clear[1]);
        EXPECT_TRUE(warns(tank.text(), "once \"leads out\" has risen")) << tank.text();
        EXPECT_FALSE(warns(tank.text(), "once \"shut\"")) << tank.text();
    }
}

// A plug that is drawn out of a hole in the floor, or a floor that rises with all of its water.
TEST(PlanLeaks, AHoleBelowAPlugThatRisesIsTold)
{
    Dice dice(82);
    for (int n = 0; n < number_from("HYORYU_DRAWS", 8); ++n) {
        Tank tank = drawn(dice, 2);
        tank.open = ", \"-z\"";
        const double plug = tank.low.x() + dice.between(0.15, 0.2);
        const double end = plug + dice.between(5, 7) * tank.dp;
        const auto floor = [&](double from, double to, const std::string& name) {
            return fmt::format(
                "[[wall]]\nname = \"{}\"\nshape = \"box\"\nmin = [{}, 0, -0.2]\nmax = "
                "[{}, 0, 0]\n",
                name, from, to);
        };
        const std::string lift = "[wall.motion]\nlift = { speed = 1 }\n";
        tank.more = floor(tank.low.x() - 0.3, plug, "left") +
                    floor(end, tank.high.x() + 0.3, "right") + floor(plug, end, "plug") + lift;
        EXPECT_TRUE(warns(tank.text(), "once \"plug\" has risen")) << tank.text();
        tank.more = floor(tank.low.x(), tank.high.x(), "bed") + lift;
        EXPECT_FALSE(warns(tank.text(), "has risen")) << tank.text();
    }
}

// A drop that falls into the tank has no more head than its own height.
TEST(PlanLeaks, WaterAboveItsSidesIsToldAndADropAboveATankIsNot)
{
    Dice dice(76);
    for (int n = 0; n < number_from("HYORYU_DRAWS", 16); ++n) {
        Tank tank = drawn(dice, n % 4 == 0 ? 2 : 3);
        const bool flat = tank.dimensions == 2;
        const Vec3 middle = (tank.low + tank.high) / 2;
        tank.more =
            fmt::format("[[fluid.block]]\nshape = \"box\"\nmin = [{}, {}, 1.2]\nmax = [{}, {}, "
                        "1.5]\n",
                        middle.x() - 0.1, flat ? 0 : middle.y() - 0.1, middle.x() + 0.1,
                        flat ? 0 : middle.y() + 0.1);
        EXPECT_FALSE(warns(tank.text(), drop)) << tank.text();
        tank.more.clear();
        tank.top = dice.between(0.45, 0.6);
        EXPECT_FALSE(warns(tank.text(), drop)) << tank.text();
        tank.top = dice.between(0.08, 0.2);
        EXPECT_TRUE(warns(tank.text(), drop)) << tank.text();
    }
}

TEST(PlanLeaks, AreNotToldWhereWaterMayLeave)
{
    Dice dice(73);
    for (int n = 0; n < number_from("HYORYU_DRAWS", 16); ++n) {
        Tank tank = drawn(dice, 3);
        if (n % 2 == 0) { // a column of the warning has its middle just beyond the period
            tank.low.x() = tank.dp * (dice.below(20) + 0.5 - dice.between(0, 0.05));
        }
        tank.high.x() = tank.low.x() + tank.dp * (12 + dice.below(12)); // a period is of whole ones
        tank.open = ", \"-x\", \"+x\"";
        EXPECT_TRUE(warns(tank.text(), drop));
        tank.more = fmt::format("[domain]\nmin = [{0}, {1}, -1]\nmax = [{2}, {3}, 2]\nperiodic = "
                                "[\"x\"]\n",
                                tank.low.x(), tank.low.y() - 1, tank.high.x(), tank.high.y() + 1);
        EXPECT_FALSE(warns(tank.text(), drop)) << tank.text();
    }
}

TEST(PlanLeaks, AWindowLetsOutAsFarAsItReaches)
{
    Dice dice(79);
    for (int n = 0; n < number_from("HYORYU_DRAWS", 8); ++n) {
        Tank tank = drawn(dice, 3);
        tank.open = ", \"+x\"";
        const auto with_window_to = [&](double end) {
            Tank with = tank;
            with.more =
                fmt::format("[[open]]\nname = \"sea\"\nmin = [{0}, {1}, 0]\nmax = [{0}, {2}, "
                            "1]\ninto = \"-x\"\nkind = \"absorb\"\n",
                            tank.high.x(), tank.low.y(), end);
            return warns(with.text(), drop);
        };
        EXPECT_FALSE(with_window_to(tank.high.y())) << tank.text();
        EXPECT_TRUE(with_window_to(tank.low.y() + dice.between(0.1, 0.25))) << tank.text();
    }
}

TEST(PlanLeaks, ABodyBesideTheTankIsTold)
{
    Dice dice(74);
    for (int n = 0; n < number_from("HYORYU_DRAWS", 24); ++n) {
        Tank tank = drawn(dice, n % 4 == 0 ? 2 : 3);
        const bool flat = tank.dimensions == 2;
        const double edge = dice.between(0.1, 0.2);
        const auto with_body_at = [&](const Vec3& place, const std::string& more) {
            Tank with = tank;
            with.more = fmt::format("[[body]]\nshape = \"box\"\nsize = [{0}, {0}, {0}]\ndensity = "
                                    "500\nposition = [{1}, {2}, {3}]\n{4}",
                                    edge, place.x(), flat ? 0 : place.y(), place.z(), more);
            return warns(with.text(), "neither wall nor water below");
        };
        const Vec3 middle = (tank.low + tank.high) / 2 + Vec3(0, 0, dice.between(0.3, 0.8));
        EXPECT_FALSE(with_body_at(middle, "")) << tank.text();
        const int axis = flat ? 0 : dice.below(2);
        const double way = dice.chance(0.5) ? 1 : -1;
        const Vec3 beside = middle + way * (0.6 + dice.between(0.5, 3)) * Vec3::Unit(axis);
        EXPECT_TRUE(with_body_at(beside, "")) << tank.text() << beside.transpose();
        EXPECT_FALSE(with_body_at(beside, "fixed = true\n"));
        EXPECT_FALSE(with_body_at(beside, "[[wall]]\nshape = \"plane\"\n"));
    }
}

TEST(PlanLeaks, ABodyBelowTheTankFallsAndDoesNotFloatUp)
{
    Dice dice(78);
    for (int n = 0; n < number_from("HYORYU_DRAWS", 16); ++n) {
        Tank tank = drawn(dice, n % 4 == 0 ? 2 : 3);
        const Vec3 middle = (tank.low + tank.high) / 2;
        const auto with_body_at = [&](double z) {
            Tank with = tank;
            with.more =
                fmt::format("[[body]]\nshape = \"box\"\nsize = [0.14, 0.14, 0.14]\ndensity = "
                            "500\nposition = [{}, {}, {}]\n",
                            middle.x(), tank.dimensions == 2 ? 0 : middle.y(), z);
            return with.text();
        };
        const std::string below = with_body_at(dice.between(-3, -0.5));
        EXPECT_TRUE(warns(below, "neither wall nor water below")) << below;
        EXPECT_FALSE(warns(below, "rise rapidly")) << below;
        const std::string sunk = with_body_at(dice.between(0.071, 0.14));
        EXPECT_FALSE(warns(sunk, "neither wall nor water below")) << sunk;
        EXPECT_TRUE(warns(sunk, "rise rapidly")) << sunk;
    }
}

TEST(PlanLeaks, ABasinOfFewSpacingsIsNotResolved)
{
    Dice dice(75);
    for (int n = 0; n < number_from("HYORYU_DRAWS", 16); ++n) {
        Tank tank = drawn(dice, 3);
        EXPECT_FALSE(warns(tank.text(), "is not resolved")) << tank.text();
        const int axis = dice.below(2);
        tank.dp = (tank.high - tank.low)[axis] / dice.between(0.5, 2.95);
        EXPECT_TRUE(warns(tank.text(), fmt::format("along {},", "xy"[axis]))) << tank.text();
    }
}

TEST(PlanLeaks, ACourantNumberBeyondStabilityIsTold)
{
    for (const double cfl : {0.2, 0.6, 1.15, 1.25, 3.0, 50.0}) {
        const std::string text =
            Tank{.high = {1, 1, 0}, .more = "[domain]\nmin = [-1, -1, -1]\nmax = [2, 2, 2]\n"}
                .text();
        const std::string with = fmt::format("{}cfl = {}\n{}", text.substr(0, text.find("[part")),
                                             cfl, text.substr(text.find("[part")));
        EXPECT_EQ(warns(with, "longer than the stability limit"), cfl > 1.2) << cfl;
    }
}

} // namespace
} // namespace hyoryu::test_plan_leaks
