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

// A platform whose top is at or near the ground rises with a heavy box on it; lengths in spacings.
struct Lift {
    double dp = 0.02;
    double depth = 14;
    double top = 0, deep = 10, wide = 16; // of the platform at time 0
    double length = 10, height = 7;       // of the box
    double way = 2;
    std::string ground = "basin"; // or "box": one box below the sides of the basin

    double time() const { return 25 * std::sqrt(depth * dp / g); }
    std::string text() const
    {
        const double middle = 25;
        const double top_of_box = top + height;
        const bool has_floor = ground == "basin";
        const std::string tank = fmt::format(
            "[[wall]]\nshape = \"basin\"\nmin = [0, 0, {}]\nmax = [{}, 0, {}]\nopen = {}\n",
            has_floor ? 0 : -9 * dp, 50 * dp, 24 * dp, has_floor ? "[\"+z\"]" : "[\"-z\", \"+z\"]");
        const std::string floor =
            fmt::format("[[wall]]\nshape = \"box\"\nmin = [{}, 0, {}]\nmax = [{}, 0, 0]\n", -9 * dp,
                        -9 * dp, 59 * dp);
        const std::string platform =
            fmt::format("[[wall]]\nshape = \"box\"\nmin = [{}, 0, {}]\nmax = [{}, 0, {}]\n"
                        "[wall.motion]\ntimes = [0, {}]\nplaces = [[0, 0, 0], [0, 0, {}]]\n",
                        (middle - wide / 2) * dp, (top - deep) * dp, (middle + wide / 2) * dp,
                        top * dp, time(), way * dp);
        const std::string box = fmt::format(
            "[[body]]\nname = \"b\"\nshape = \"box\"\nsize = [{}, 1, {}]\ndensity = 3000\n"
            "position = [{}, 0, {}]\n",
            length * dp, height * dp, middle * dp, (top + top_of_box) / 2 * dp);
        return fmt::format("dimensions = 2\n[time]\nend = 99\n[particles]\nspacing = {}\n[fluid]\n"
                           "viscosity.alpha = 0.05\n[contact]\nrestitution = 0.0\n"
                           "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [{}, 0, {}]\n",
                           dp, 50 * dp, depth * dp) +
               tank + (has_floor ? "" : floor) + platform + box;
    }
};

// The least and largest uplift of the submerged box from a quarter of the way on, by Archimedes'.
std::pair<double, double> uplifts_of(const Lift& lift)
{
    Simulation sim = make(lift.text());
    const double exact = rho * g * lift.length * lift.height * sq(lift.dp);
    std::pair<double, double> found{infinity, 0};
    double sum = 0;
    double mean_from = lift.time() / 4;
    int steps = 0;
    while (sim.clock.time < 1.25 * lift.time()) {
        step_on(sim);
        if (sim.clock.time > mean_from) {
            sum += sim.loads.bodies.at(0).force.z() / exact;
            ++steps;
        }
        if (sim.clock.time > mean_from + lift.time() / 4) { // means, over some periods of sound
            found = {std::min(found.first, sum / steps), std::max(found.second, sum / steps)};
            mean_from = sim.clock.time;
            sum = 0;
            steps = 0;
        }
    }
    return found;
}

// With the volume of the fixed wall in place of that of the platform: 0.55 to 0.88. A tenth of a
// spacing on each of two faces is 4 % of the least height, and the water sways.
TEST(CoveredWalls, ABoxOnAPlatformThatRisesOutOfTheGroundHasItsUplift)
{
    Dice dice(83);
    for (int n = 0; n < 6; ++n) {
        Lift lift;
        lift.dp = n % 2 == 0 ? 0.02 : 0.05;
        lift.top = n % 3 == 0 ? 0 : dice.between(0, 0.6);
        lift.deep = dice.between(4, 12);
        lift.wide = dice.between(14, 20);
        lift.length = dice.between(8, 11);
        lift.height = dice.between(5, 8);
        lift.way = dice.between(1, 3);
        lift.ground = n < 3 ? "basin" : "box";
        const auto [least, most] = uplifts_of(lift);
        const std::string drawn = fmt::format("draw {}: top at {}, way {} spacings, {}", n,
                                              lift.top, lift.way, lift.ground);
        EXPECT_GT(least, 0.95) << drawn;
        EXPECT_LT(most, 1.05) << drawn;
    }
}

} // namespace
} // namespace hyoryu::test_covered_walls
