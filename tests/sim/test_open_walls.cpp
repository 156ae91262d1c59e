// SPDX-License-Identifier: MIT
// Walls in the strip before an open side, in which depth and velocity are measured: piers,
// buildings and sills of drawn places and sizes, at two spacings.
#include "open_scenes.hpp"
#include "runs.hpp"

#include "dice.hpp"

#include "hyoryu/sim/gauges.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <ranges>

namespace hyoryu::test_open_walls {
namespace {

// A channel of still water; both of its ends are windows.
Reach channel(double spacing, int rows)
{
    Reach r;
    r.dimensions = 3;
    r.spacing = spacing;
    r.length = 18 * spacing;
    r.width = 10 * spacing;
    r.depth = rows * spacing;
    return r;
}

// A wall that begins `gap` spacings inside the near window, of a drawn length and width; `top`:
// its height [m].
std::string wall_inside(Dice& dice, const Reach& r, double gap, double top)
{
    const double dp = r.spacing;
    const double size = dice.between(2, 6) * dp;
    const double x = r.from + gap * dp;
    if (dice.chance(0.3)) { // a pier
        const double radius = dice.between(1.5, 3) * dp;
        const double y = dice.between(3, 7) * dp;
        std::string corners;
        for (int k = 0; k < 12; ++k) {
            const double angle = 2 * std::numbers::pi * k / 12;
            corners += fmt::format("[{}, {}, 0], ", x + radius * (1 + std::cos(angle)),
                                   y + radius * std::sin(angle));
        }
        return fmt::format("[[wall]]\nname = \"pier\"\nshape = \"prism\"\ncorners = [{}]\n"
                           "bottom = -0.3\ntop = {}\n",
                           corners, top);
    }
    const double width = dice.between(2, 7) * dp;
    const double y = dice.between(0, 10 * dp - width);
    return fmt::format("[[wall]]\nname = \"house\"\nshape = \"box\"\nmin = [{}, {}, -0.3]\n"
                       "max = [{}, {}, {}]\n",
                       x, y, x + size, y + width, top);
}

struct Through {
    double in = 0, out = 0; // [m3]
    double lowest = infinity, highest = -infinity;
};

Through run_for(Simulation& sim, double time)
{
    Through through;
    while (sim.clock.time < time) {
        const OpenReading now = reading_of(sim, 0);
        through.lowest = std::min(through.lowest, now.level);
        through.highest = std::max(through.highest, now.level);
        step_on(sim);
    }
    const OpenReading last = reading_of(sim, 0);
    through.in = last.volume_in;
    through.out = last.volume_out;
    return through;
}

// Water at rest stays there, whatever stands before the window and whichever its kind. The bounds
// are from 56 draws. Beside a wall the filling leaves out up to half a lattice plane, so that the
// level is low by at most 0.37 spacings; it moves by less than 0.1. Of 900 or 1080 particles at
// most eight pass the plane, and come back, while the water settles. With walls left out of account
// 8 to 18 % of the water left within a second.
TEST(OpenWalls, StillWaterBesideWallsStaysAtRest)
{
    Dice dice(41);
    for (int n = 0; n < 6; ++n) {
        Reach r = channel(n % 2 == 0 ? 0.1 : 0.0625, 5 + dice.below(2));
        const std::array<std::string, 3> kinds{"kind = \"absorb\"\n", "kind = \"outflow\"\n",
                                               "kind = \"inflow\"\ndischarge = 0.0\n"};
        r.near = kinds[static_cast<std::size_t>(n) % 3];
        const double top = n == 3 ? 0.4 * r.depth : dice.chance(0.5) ? 1.2 : r.depth + 0.15;
        const std::string text = case_of(r) + wall_inside(dice, r, dice.between(1, 7), top);
        SCOPED_TRACE(text);
        Simulation sim = make(text);
        const double water = r.length * r.width * r.depth;
        const Through through = run_for(sim, 0.3);
        EXPECT_GT(through.lowest, r.depth - 0.5 * r.spacing);
        EXPECT_LT(through.highest, r.depth + 0.1 * r.spacing);
        EXPECT_LT(through.highest - through.lowest, 0.15 * r.spacing);
        EXPECT_LT(std::abs(through.in - through.out), 0.01 * water);
        EXPECT_LT(through.in + through.out, 0.025 * water);
    }
}

// A prescribed discharge enters as a whole, beside walls in the strip and in the window itself. It
// is asked for exactly. The lanes of a carpet cross the plane together, also without any wall, so
// that what has entered is known to one column of the depth at most. About three enter.
TEST(OpenWalls, APrescribedDischargeEntersBesideWalls)
{
    Dice dice(42);
    for (int n = 0; n < 4; ++n) {
        Reach r = channel(n % 2 == 0 ? 0.1 : 0.0625, 6);
        const double q = dice.between(0.1, 0.25) * std::sqrt(9.81 * r.depth) * r.depth * r.width;
        r.near = fmt::format("kind = \"inflow\"\ndischarge = {}\n", q);
        const double gap = n < 2 ? 0 : dice.between(1, 7);
        const std::string text =
            case_of(r) + wall_inside(dice, r, gap, dice.chance(0.5) ? 1.2 : r.depth + 0.3);
        SCOPED_TRACE(text);
        Simulation sim = make(text);
        const Through through = run_for(sim, 0.6);
        const double asked = q * sim.clock.time;
        EXPECT_NEAR(reading_of(sim, 0).volume_asked, asked, 1e-6 * asked);
        const double column = r.spacing * r.width * through.highest;
        EXPECT_NEAR(through.in - through.out, asked, column);
        EXPECT_GT(through.lowest, r.depth - 0.5 * r.spacing);
    }
}

// Speed of the fluid, root mean square / speed of long waves.
double mean_speed(const Simulation& sim, double depth)
{
    const Store& water = sim.fluid->particles.fluid;
    double sum = 0;
    for (Index row = 0; row < water.size(); ++row) {
        const Vec3 v = water[field::velocity][row];
        sum += v.squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(water.size()) / (9.81 * depth));
}

// Still water between two windows, in channels whose width is no whole number of spacings, rests
// like that in a basin: without flows from one station to the next, and near its level; that a
// block of such a depth has up to 0.3 spacings less on its top row is not of the window. Water that
// starts on such a lattice rearranges at up to 0.02. Where lanes left a dry gap at the walls, or a
// station counted particles by their middles alone, it flowed at 0.03 to 0.05 for good.
TEST(OpenWalls, StillWaterRestsBetweenWindowsOfAnyWidth)
{
    Dice dice(45);
    for (int n = 0; n < 6; ++n) {
        Reach r = channel(n % 2 == 0 ? 0.1 : 0.05, 6);
        const double odd = n < 3 ? dice.between(0.05, 0.95) : dice.between(0.45, 0.55);
        r.width = (6 + n + odd) * r.spacing;
        r.depth = dice.between(5.5, 7.5) * r.spacing;
        r.near = "kind = \"absorb\"\n";
        const std::string text = case_of(r);
        SCOPED_TRACE(text);
        Simulation sim = make(text);
        const double end = 15 * std::sqrt(r.depth / 9.81);
        while (sim.clock.time < end) {
            step_on(sim);
        }
        EXPECT_LT(mean_speed(sim, r.depth), 0.02);
        EXPECT_NEAR(reading_of(sim, 0).level, r.depth, 0.4 * r.spacing);
    }
}

// The lattice of the water need not be that of the lanes, and its rows lie anywhere about the
// limits of the stations: still water has one depth at all of them.
TEST(OpenWalls, StationsMeasureOneDepthOnAnyLattice)
{
    Dice dice(46);
    double largest = 0; // difference of two stations / depth
    for (int n = 0; n < 60; ++n) {
        Reach r = channel(n % 2 == 0 ? 0.1 : 0.05, 6);
        r.width = dice.between(8.05, 16.95) * r.spacing;
        const Simulation sim = make(case_of(r));
        const auto depths = std::views::transform(sim.open.boundary.carpets[0].stations,
                                                  [](const StationFlow& s) { return s.depth; });
        largest =
            std::max(largest, (std::ranges::max(depths) - std::ranges::min(depths)) / r.depth);
    }
    EXPECT_LT(largest, 0.06);
}

// The window is the whole side of a channel whose width is no whole number of spacings: all of the
// discharge enters.
TEST(OpenWalls, APrescribedDischargeEntersThroughAWindowOfAnyWidth)
{
    Dice dice(44);
    for (int n = 0; n < 4; ++n) {
        Reach r = channel(n % 2 == 0 ? 0.1 : 0.0625, 6);
        r.width = dice.between(6.05, 9.95) * r.spacing;
        const double q = dice.between(0.1, 0.25) * std::sqrt(9.81 * r.depth) * r.depth * r.width;
        r.near = fmt::format("kind = \"inflow\"\ndischarge = {}\n", q);
        const std::string text = case_of(r);
        SCOPED_TRACE(text);
        Simulation sim = make(text);
        const Through through = run_for(sim, 0.6);
        const double asked = q * sim.clock.time;
        EXPECT_NEAR(reading_of(sim, 0).volume_asked, asked, 1e-6 * asked);
        EXPECT_NEAR(through.in - through.out, asked, r.spacing * r.width * through.highest);
    }
}

// The front is that of the fluid in the domain: it passes no open side.
TEST(OpenWalls, AFrontEndsAtAnOpenSide)
{
    Dice dice(43);
    for (const double spacing : {0.05, 0.0625}) {
        Reach r;
        r.spacing = spacing;
        r.length = spacing * (14 + dice.below(6));
        r.depth = 5 * spacing;
        const std::string text =
            case_of(r) + "[[gauge]]\nname = \"front\"\ntype = \"front\"\naxis = \"x\"\n";
        SCOPED_TRACE(text);
        Simulation sim = make(text);
        for (int k = 0; k < 20; ++k) {
            const double front = read_gauges(sim).front();
            EXPECT_LE(front, r.from + r.length + spacing / 2);
            EXPECT_GT(front, r.from + r.length - spacing);
            step_on(sim);
        }
    }
}

} // namespace
} // namespace hyoryu::test_open_walls
