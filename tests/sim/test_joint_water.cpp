// SPDX-License-Identifier: MIT
// Joints and the water beside them: what closes on water, shafts that a body fills, and crates over
// the edge of what they stand on.
#include "dice.hpp"
#include "runs.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <random>

namespace hyoryu::test_joint_water {
namespace {

// A ram crushes a box in water against the end of a basin; fastest it gets before they all meet, in
// speeds of the ram.
double fastest_crushed(double spacing, double beside, double level, double speed)
{
    const double width = 0.4;
    const double end = 2 * beside + width + 0.2;
    const std::string text = fmt::format(
        "dimensions = 2\n[time]\nend = 10.0\n[particles]\nspacing = {}\n[fluid]\n"
        "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [{}, 0, {}]\n"
        "[[wall]]\nname = \"basin\"\nshape = \"basin\"\nmin = [0, 0, 0]\nmax = [{}, 0, 1.4]\n"
        "open = [\"+z\"]\n"
        "[[wall]]\nname = \"ram\"\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [0.2, 0, 1]\n"
        "[wall.motion]\nvelocity = [{}, 0, 0]\n"
        "[[body]]\nname = \"box\"\nshape = \"box\"\nsize = [{}, 0, 0.4]\ndensity = 600\n"
        "position = [{}, 0, 0.2]\nlocks = [\"z\", \"ry\"]\n",
        spacing, end, level, end, speed, width, 0.2 + beside + width / 2);
    Simulation sim = make(text);
    double fastest = 0;
    while (sim.clock.time < 0.99 * 2 * beside / speed) {
        step_on(sim);
        fastest = std::max(fastest, std::abs(sim.rigid.bodies[0].velocity.x()));
    }
    return fastest / speed;
}

// A joint that begins where faces close on water leaves what they have trapped to its particles:
// without that the box is thrown at the ram by what is trapped on its other side. Squeezed from
// both sides it goes at 0.6 to 0.9 of the speed of the ram and should never overtake it. Known to
// fail: in three of 48 draws the last particles throw it ahead, at up to 1.31 speeds of the ram;
// with three or four spacings of water on either side in one of four, at up to 1.8.
TEST(Seepage, FacesThatCloseOnWaterAreHeldApartByIt)
{
    Dice dice(7);
    const int draws = number_from("HYORYU_DRAWS", 12);
    std::vector<double> fastest;
    for (int k = 0; k < draws; ++k) {
        const double spacing = k % 2 == 0 ? 0.015 : 0.02;
        const double beside = dice.between(0.1, 0.2);
        const double level = dice.between(0.2, 0.3);
        const double speed = dice.between(0.3, 0.6);
        fastest.push_back(fastest_crushed(spacing, beside, level, speed));
    }
    std::ranges::sort(fastest);
    EXPECT_LT(fastest[fastest.size() / 2], 0.85);
    EXPECT_LE(fastest[fastest.size() * 9 / 10], 1);
    EXPECT_LT(fastest.back(), 1.5);
}

// A body that fills its shaft, on water that a second shaft presses up: the joints beside it take
// nothing from the water below. Heights are in multiples of 0.1 m.
std::string shafts(double spacing, double ratio, const char* stands)
{
    constexpr double width = 0.4;
    const double right = 0.8;                        // level under the body
    const double left = right + ratio * width + 0.2; // 0.2 m above the level of rest
    const auto block = [](double from, double to, double low, double high) {
        return fmt::format(
            "[[fluid.block]]\nshape = \"box\"\nmin = [{}, 0, {}]\nmax = [{}, 0, {}]\n", from, low,
            to, high);
    };
    return fmt::format("dimensions = 2\n[time]\nend = 10.0\n[particles]\nspacing = {}\n"
                       "[fluid]\n{}{}{}"
                       "[[wall]]\nname = \"tube\"\nshape = \"basin\"\nmin = [0, 0, 0]\n"
                       "max = [1.2, 0, {}]\nopen = [\"+z\"]\n"
                       "[[wall]]\nname = \"divide\"\nshape = \"box\"\nmin = [0.4, 0, 0.4]\n"
                       "max = [0.8, 0, {}]\n"
                       "[[body]]\nname = \"piston\"\nshape = \"box\"\nsize = [0.4, 0, 0.4]\n"
                       "density = {}\nposition = [1.0, 0, {}]\nlocks = [\"x\", \"ry\"]\n"
                       "stands = \"{}\"\n[contact]\nfriction = 0\nrestitution = 0\n",
                       spacing, block(0, width, 0.4, left), block(0.8, 1.2, 0.4, right),
                       block(0, 1.2, 0, 0.4), left + 1, left + 1, 1000 * ratio, right + width / 2,
                       stands);
}

TEST(Seepage, JointsBesideABodyLeaveTheWaterBelowItAlone)
{
    std::mt19937 dice(5);
    for (const double spacing : {0.1, 0.05}) {
        for (int draw = 0; draw < 2; ++draw) {
            const double ratio = std::uniform_int_distribution<int>(1, 8)(dice) / 2.0;
            const auto rise = [&](const char* stands) {
                Simulation sim = make(shafts(spacing, ratio, stands));
                while (sim.clock.time < 0.2) {
                    step_on(sim);
                }
                return sim.rigid.bodies[0].position.z() - 1.0;
            };
            const double sealed = rise("sealed");
            EXPECT_GT(sealed, 0.005);
            // a tenth; joints that took all film forces left 0.8 of the rise at ratio 1, 0.24 at 4
            EXPECT_NEAR(rise("open"), sealed, 0.1 * sealed) << spacing << " " << ratio;
        }
    }
}

// Mean upward forces of the water on the first and the last body between two times [N].
std::array<double, 2> mean_lifts(Simulation& sim, double from, double to)
{
    std::array<double, 2> sums{};
    int count = 0;
    while (sim.clock.time < to) {
        step_on(sim);
        if (sim.clock.time > from) {
            sums[0] += sim.loads.bodies.front().force.z();
            sums[1] += sim.loads.bodies.back().force.z();
            ++count;
        }
    }
    return {sums[0] / count, sums[1] / count};
}

double mean_lift(Simulation& sim, double from, double to)
{
    return mean_lifts(sim, from, to)[0];
}

// A crate over the edge of a ledge, in water deeper than the ledge is high: all of its lower face
// feels the water at its depth, wherever the edge falls between the particles of the crate. Half a
// spacing of depth is allowed.
TEST(Seepage, ACrateOverAnEdgeFeelsTheWaterOnBothSidesOfIt)
{
    std::mt19937 dice(23);
    std::uniform_real_distribution<double> part(0, 1);
    for (const double dp : {0.0625, 0.05, 0.04}) {
        for (int k = 0; k < 6; ++k) {
            const double width = 0.7 + 0.3 * part(dice);
            const double over = width * (0.1 + 0.35 * part(dice));
            const double ledge = 0.3;
            const double depth = 0.35 + 0.1 * part(dice);
            const double edge = 1.2 + dp * part(dice);
            Simulation sim = make(fmt::format(
                "dimensions = 2\n[time]\nend = 10\n[particles]\nspacing = {0}\n[fluid]\n"
                "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [2.4, 0, {1}]\n"
                "[[wall]]\nshape = \"basin\"\nmin = [0, 0, 0]\nmax = [2.4, 0, 1.5]\n"
                "open = [\"+z\"]\n[[wall]]\nshape = \"box\"\nmin = [0, 0, 0]\n"
                "max = [{2}, 0, {3}]\n[[body]]\nname = \"crate\"\nshape = \"box\"\n"
                "size = [{4}, 0, 0.6]\ndensity = 900\nposition = [{5}, 0, {6}]\n"
                "fixed = true\nstands = \"open\"\n",
                dp, ledge + depth, edge, ledge, width, edge + over - width / 2, ledge + 0.3));
            const double lift = mean_lift(sim, 0.1, 0.25);
            const double expected = 9810 * width * depth;
            EXPECT_NEAR(lift, expected, 9810 * width * dp / 2)
                << "spacing " << dp << ", overhang of " << over / dp << " spacings";
        }
    }
}

// A crate on a fixed base that is wider and lower than the crate, with water over the ledge beside
// it: the films between the ledge and the crate do not lift it. Uplift by Archimedes within half a
// spacing; 0.7 to 2.3 where the base carried the joint, since it is the smaller body.
TEST(Seepage, ACrateOnAWideBaseFeelsTheWaterAtItsDepth)
{
    std::mt19937 dice(44);
    std::uniform_real_distribution<double> part(0, 1);
    for (const double dp : {0.05, 0.035, 0.025}) {
        for (int k = 0; k < 6; ++k) {
            const double width = 0.25 + 0.2 * part(dice);
            const double ledge = dp * 3 * part(dice);
            const double base = dp * (3 + 4 * part(dice));
            const double depth = 0.15 + 0.15 * part(dice);
            const double end = width / 2 + ledge + 0.2 + 0.1 * part(dice);
            Simulation sim = make(fmt::format(
                "dimensions = 2\n[time]\nend = 10\n[particles]\nspacing = {0}\n[fluid]\n"
                "[[fluid.block]]\nshape = \"box\"\nmin = [{1}, 0, 0]\nmax = [{2}, 0, {3}]\n"
                "[[wall]]\nshape = \"basin\"\nmin = [{1}, 0, 0]\nmax = [{2}, 0, 2]\n"
                "open = [\"+z\"]\n[[body]]\nshape = \"box\"\nsize = [{4}, 0, 0.6]\n"
                "density = 4000\nposition = [0, 0, {5}]\n[[body]]\nshape = \"box\"\n"
                "size = [{6}, 0, {7}]\ndensity = 8000\nposition = [0, 0, {8}]\nfixed = true\n",
                dp, -end, end, base + depth, width, base + 0.3, width + 2 * ledge, base, base / 2));
            const double lift = mean_lift(sim, 0.25, 0.5);
            EXPECT_NEAR(lift / (9810 * width * dp), depth / dp, 0.5)
                << "spacing " << dp << ", ledge of " << ledge / dp << " spacings";
        }
    }
}

// A crate on the floor of a tank. Neither fits the lattice.
std::string in_tank(int dimensions, double dp, const Vec3& size, double gap, double depth,
                    const std::string& keys)
{
    const double x = size.x() / 2 + gap;
    const double y = dimensions == 3 ? size.y() / 2 + gap : 0;
    return fmt::format("dimensions = {}\n[time]\nend = 10\n[particles]\nspacing = {}\n[fluid]\n"
                       "[[fluid.block]]\nshape = \"box\"\nmin = [{}, {}, 0]\nmax = [{}, {}, {}]\n"
                       "[[wall]]\nshape = \"basin\"\nmin = [{}, {}, 0]\nmax = [{}, {}, {}]\n"
                       "open = [\"+z\"]\n[[body]]\nname = \"crate\"\nshape = \"box\"\n"
                       "size = [{}, {}, {}]\nposition = [0, 0, {}]\n{}\n",
                       dimensions, dp, -x, -y, x, y, depth, -x, -y, x, y, depth + 1, size.x(),
                       size.y(), size.z(), size.z() / 2, keys);
}

// Uplift by Archimedes at the level that was asked for, within half a spacing of water, in water of
// 6 to 34 spacings: water whose particles do not have the mass of their cells presses by up to 5 %
// too much or too little, so that fine spacings were the worst.
TEST(Seepage, UpliftIsThatOfTheLevelInShallowAndDeepWater)
{
    std::mt19937 dice(41);
    std::uniform_real_distribution<double> part(0, 1);
    for (const double dp : {0.05, 0.025, 0.0125}) {
        for (int k = 0; k < (dp < 0.02 ? 2 : 4); ++k) {
            const double width = 0.3 + 0.2 * part(dice);
            const double depth = 0.3 + 0.12 * part(dice);
            Simulation sim = make(in_tank(2, dp, Vec3(width, 0, 0.6), 0.15 + 0.15 * part(dice),
                                          depth, "density = 3000"));
            const double lift = mean_lift(sim, 0.25, 0.5);
            EXPECT_NEAR(lift / (9810 * width * dp), depth / dp, 0.5) << "spacing " << dp;
        }
    }
}

// Two crates a narrow gap apart, on both sides of x = 0, in a tank that no lattice fits.
std::string two_crates(double dp, double gap, const std::array<double, 2>& widths, double beside,
                       double depth)
{
    const double left = -gap / 2 - widths[0] - beside;
    const double right = gap / 2 + widths[1] + beside;
    const auto crate = [](double width, double x) {
        return fmt::format("[[body]]\nshape = \"box\"\nsize = [{}, 0, 0.6]\ndensity = 3000\n"
                           "position = [{}, 0, 0.3]\n",
                           width, x);
    };
    return fmt::format("dimensions = 2\n[time]\nend = 10\n[particles]\nspacing = {}\n[fluid]\n"
                       "[[fluid.block]]\nshape = \"box\"\nmin = [{}, 0, 0]\nmax = [{}, 0, {}]\n"
                       "[[wall]]\nshape = \"basin\"\nmin = [{}, 0, 0]\nmax = [{}, 0, 2]\n"
                       "open = [\"+z\"]\n{}{}",
                       dp, left, right, depth, left, right,
                       crate(widths[0], -(gap + widths[0]) / 2),
                       crate(widths[1], (gap + widths[1]) / 2));
}

// A gap of one or two columns of particles has no true pressure at its bottom, three spacings of
// water too much at worst: the open water on the other side of each crate decides. Uplift by
// Archimedes within half a spacing.
TEST(Seepage, ANarrowGapBesideACrateDoesNotChangeItsUplift)
{
    std::mt19937 dice(43);
    std::uniform_real_distribution<double> part(0, 1);
    for (const double dp : {0.05, 0.025, 0.0125}) {
        for (int k = 0; k < (dp < 0.02 ? 3 : 10); ++k) {
            const double gap = 1 + 1.6 * part(dice); // spacings
            const std::array widths{0.3 + 0.2 * part(dice), 0.3 + 0.2 * part(dice)};
            const double depth = 0.25 + 0.15 * part(dice);
            Simulation sim = make(two_crates(dp, gap * dp, widths, 0.2 + 0.1 * part(dice), depth));
            const std::array<double, 2> lifts = mean_lifts(sim, 0.25, 0.5);
            for (std::size_t b = 0; b < 2; ++b) {
                EXPECT_NEAR(lifts[b] / (9810 * widths[b] * dp), depth / dp, 0.5)
                    << "crate " << b << ", gap of " << gap << " spacings of " << dp;
            }
        }
    }
}

// A crate half a spacing lighter than its draft rises until its draft is that of the level beside
// it, which falls by the water that has come under it. Half a spacing; particles that pressed in
// addition to the joint while it opened made it rise by 0.7 to 1.4.
TEST(Seepage, ACrateThatFloatsUpStopsAtItsDraft)
{
    std::mt19937 dice(45);
    std::uniform_real_distribution<double> part(0, 1);
    for (const double dp : {0.05, 0.025}) {
        for (int k = 0; k < 24; ++k) {
            const Vec3 size(0.3 + 0.2 * part(dice), 0, 0.5);
            const double beside = 0.2 + 0.1 * part(dice);
            const double depth = 0.25 + 0.15 * part(dice);
            const double draft = depth - 0.5 * dp;
            Simulation sim = make(in_tank(2, dp, size, beside, depth,
                                          fmt::format("density = {}", 1000 * draft / size.z())));
            while (sim.clock.time < 1) {
                step_on(sim);
            }
            const double risen = (sim.rigid.bodies[0].position.z() - size.z() / 2) / dp;
            EXPECT_NEAR(risen, 0.5 * 2 * beside / (2 * beside + size.x()), 0.5)
                << "spacing " << dp << ", draw " << k;
            EXPECT_GT(risen, 0.1);
        }
    }
}

// No pressure gets under a sealed crate, however light it is and whatever it stands on.
TEST(Seepage, ASealedCrateNeverLifts)
{
    std::mt19937 dice(42);
    std::uniform_real_distribution<double> part(0, 1);
    for (int k = 0; k < 12; ++k) {
        const int dimensions = k % 4 == 3 ? 3 : 2;
        const double dp = k % 2 == 0 ? 0.05 : 0.025 * dimensions - 0.025;
        const Vec3 size{0.25 + 0.3 * part(dice), dimensions == 3 ? 0.3 : 0, 0.2 + 0.3 * part(dice)};
        const double depth = size.z() * (0.3 + part(dice));
        Simulation sim =
            make(in_tank(dimensions, dp, size, 0.2, depth,
                         fmt::format("density = {}\nstands = \"sealed\"", 30 + 300 * part(dice))));
        while (sim.clock.time < 0.5) {
            step_on(sim);
        }
        const Vec3 moved = sim.rigid.bodies[0].position - Vec3(0, 0, size.z() / 2);
        EXPECT_LT(std::abs(moved.z()), 1e-6) << k << ", spacing " << dp;
    }
}

} // namespace
} // namespace hyoryu::test_joint_water
