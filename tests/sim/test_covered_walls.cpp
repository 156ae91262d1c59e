// SPDX-License-Identifier: MIT
// Moving walls that start within fixed ones: they act on the water once, in any order of the walls,
// wherever they move to.
#include "hyoryu/sim/gauges.hpp"

#include "dice.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hyoryu::test_covered_walls {
namespace {

constexpr double rho = 1000, g = 9.81;

// A tank of still water, and a box in it that moves along x at a constant speed, then rests.
struct Push {
    double dp = 0.05;
    double depth = 8, length = 22; // of the water [spacings]
    double left = -4, right = 0;   // sides of the box [spacings]
    double bottom = 0, top = 12;   // of the box [spacings]
    double way = 5;                // [spacings]
    bool box_is_first = false;     // in the case file
    std::string open = "[\"+z\"]"; // sides of the tank
    double time() const { return 12 * std::sqrt(depth * dp / g); }

    std::string text() const
    {
        const std::string tank = fmt::format(
            "[[wall]]\nname = \"tank\"\nshape = \"basin\"\nmin = [0, 0, 0]\nmax = [{}, 0, {}]\n"
            "open = {}\n",
            length * dp, 12 * dp, open);
        const std::string box = fmt::format(
            "[[wall]]\nname = \"box\"\nshape = \"box\"\nmin = [{}, 0, {}]\nmax = [{}, 0, {}]\n"
            "[wall.motion]\ntimes = [0, {}]\nplaces = [[0, 0, 0], [{}, 0, 0]]\n",
            left * dp, bottom * dp, right * dp, top * dp, time(), way * dp);
        return fmt::format("dimensions = 2\n[time]\nend = 99\n[particles]\nspacing = {}\n[fluid]\n"
                           "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [{}, 0, {}]\n",
                           dp, length * dp, depth * dp) +
               (box_is_first ? box + tank : tank + box) +
               fmt::format("[[gauge]]\nname = \"f\"\ntype = \"force\"\non = \"box\"\n"
                           "[[gauge]]\nname = \"e\"\ntype = \"elevation\"\nat = [{0}, 0, 0]\n"
                           "[[gauge]]\nname = \"p\"\ntype = \"pressure\"\nat = [{0}, 0, 0]\n",
                           (length - 4) * dp);
    }
};

// Averages after the push.
struct Result {
    double force_x = 0, force_z = 0; // on the box [N/m]
    double level = 0;                // [m]
    double depth = 0;                // by the pressure on the floor [m]
    double lowest = infinity;        // particle of water [m]
};

Result result_of(const Push& push)
{
    Simulation sim = make(push.text());
    Result mean;
    int steps = 0;
    while (sim.clock.time < 1.5 * push.time()) {
        step_on(sim);
        if (sim.clock.time > 1.1 * push.time()) {
            const std::vector<double> row = read_gauges(sim);
            mean.force_x += row.at(0);
            mean.force_z += row.at(2);
            mean.level += row.at(row.size() - 2);
            mean.depth += row.at(row.size() - 1) / (rho * g);
            ++steps;
        }
    }
    for (double* sum : {&mean.force_x, &mean.force_z, &mean.level, &mean.depth}) {
        *sum /= steps;
    }
    for (const Vec3& x : sim.fluid->particles.fluid[field::position]) {
        mean.lowest = std::min(mean.lowest, x.z());
    }
    return mean;
}

// A piston whose face is in line with the side of the tank, in the side or in an open side. While
// it has come less than the support, the side behind it acts on the water through it.
TEST(CoveredWalls, APistonOutOfASideActsAsOneInAnOpenSide)
{
    Dice dice(81);
    for (int n = 0; n < 6; ++n) {
        Push push;
        push.dp = n % 2 == 0 ? 0.05 : 0.02;
        push.left = -dice.between(3.2, 6);
        push.way = dice.between(3.5, 7);
        push.bottom = dice.chance(0.5) ? 0 : -dice.between(0.5, 4);
        Push in_open = push;
        in_open.open = "[\"-x\", \"+z\"]";
        push.box_is_first = dice.chance(0.5);
        const Result closed = result_of(push);
        const Result open = result_of(in_open);
        const std::string drawn =
            fmt::format("draw {}: way {} spacings, foot at {}, {}", n, push.way, push.bottom,
                        push.box_is_first ? "box first" : "tank first");
        const double exact = push.depth * push.dp * push.length / (push.length - push.way);
        for (const Result& result : {closed, open}) {
            EXPECT_NEAR(result.level, exact, 0.25 * push.dp) << drawn;
            EXPECT_NEAR(result.depth, exact, 0.15 * push.dp) << drawn;
        }
        // The two depths may differ by 0.3 of at least 9 spacings.
        EXPECT_NEAR(closed.force_x / open.force_x, 1, 0.06) << drawn;
    }
}

// A block that reaches into the floor leaves whole floor behind it.
TEST(CoveredWalls, ABlockThatSlidesOffLeavesNoHoleInTheFloor)
{
    Dice dice(82);
    for (int n = 0; n < 6; ++n) {
        Push push;
        push.dp = n % 2 == 0 ? 0.05 : 0.02;
        push.length = 26;
        push.left = dice.between(4, 5);
        push.right = push.left + dice.between(4.5, 6);
        push.bottom = -dice.between(0, 4);
        push.top = dice.between(3, 4);
        push.way = push.right - push.left + dice.between(1, 3);
        push.box_is_first = n % 3 != 0;
        const Result result = result_of(push);
        const std::string drawn = fmt::format("draw {}: foot at {} spacings, {}", n, push.bottom,
                                              push.box_is_first ? "box first" : "tank first");
        EXPECT_GT(result.lowest, 0.35 * push.dp) << drawn << ": water sinks into the floor";
        const double exact =
            -rho * g * (result.depth - push.top * push.dp) * (push.right - push.left) * push.dp;
        EXPECT_NEAR(result.force_z / exact, 1, 0.05) << drawn;
    }
}

} // namespace
} // namespace hyoryu::test_covered_walls
