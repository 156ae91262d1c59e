// SPDX-License-Identifier: MIT
// Rough beds: uniform flow comes to the velocity of Manning's formula, the books of momentum close,
// the same bits come out of any number of threads and of a restart, and a smooth bed costs nothing.
#include "dice.hpp"
#include "runs.hpp"

#include "hyoryu/core/parallel.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace hyoryu::test_bed_friction {
namespace {

// A slope as a level bed on which gravity has a part along x; it repeats itself.
std::string slope(double manning, double depth, double spacing, double velocity, double drive)
{
    return fmt::format(R"(
dimensions = 2
[time]
end = 100.0
[particles]
spacing = {1}
precision = "double"
[domain]
min = [0.0, 0.0, 0.0]
max = [1.0, 0.0, 1.0]
periodic = ["x"]
[fluid]
acceleration = [{3}, 0.0, 0.0]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [1.0, 0.0, {0}]
velocity = [{2}, 0.0, 0.0]
[[wall]]
name = "bed"
shape = "plane"
manning = {4}
)",
                       depth, spacing, velocity, drive, manning);
}

// Momentum closes to the rounding of the pair sums in double precision.
constexpr double closes = 1e-10;

double mean_velocity(const Simulation& sim)
{
    const auto v = sim.fluid->particles.fluid[field::velocity];
    double sum = 0;
    for (Index i = 0; i < sim.fluid->particles.fluid.size(); ++i) {
        sum += v[i].x();
    }
    return sum / static_cast<double>(sim.fluid->particles.fluid.size());
}

double flow_for(Simulation& sim, double seconds)
{
    double sum = 0;
    int count = 0;
    while (sim.clock.time < seconds) {
        step_on(sim);
        if (sim.clock.time > 0.75 * seconds) {
            sum += mean_velocity(sim);
            ++count;
        }
    }
    return sum / count;
}

// S = 0.01, n = 0.025, h = 0.5 m: u = h^(2/3) S^(1/2) / n = 2.52 m/s, from above and from below.
// What is left of the start after t is exp(-2 g S t / u) of it: 0.31 after 15 s, of 0.1 m/s 1.2 %.
TEST(BedFriction, UniformFlowHasTheVelocityOfManning)
{
    const double drive = 0.01 * 9.81;
    const double expected = std::pow(0.5, 2.0 / 3) * std::sqrt(0.01) / 0.025;
    for (const double spacing : {0.1, 0.05}) {
        for (const double start : {expected - 0.1, expected + 0.1}) {
            Simulation sim = make(slope(0.025, 0.5, spacing, start, drive));
            EXPECT_NEAR(flow_for(sim, 15), expected, 0.04 * expected) << spacing << " " << start;
            EXPECT_LT(sim.conservation.worst_closure, closes);
            EXPECT_EQ(sim.fluid->lost.count, 0);
        }
    }
}

// Without slope the flow dies away as du/dt = -g n^2 u^2 / h^(4/3): 1/u grows linearly. While the
// water settles, a part of a row more or less is within a spacing of the bed: first order in dp/h.
TEST(BedFriction, AFlowOnALevelBedDiesAwayHyperbolically)
{
    for (const double spacing : {0.1, 0.05}) {
        for (const double n : {0.02, 0.05}) {
            Simulation sim = make(slope(n, 0.5, spacing, 2, 0));
            const double before = sim.conservation.wall_impulse.x();
            while (sim.clock.time < 4) {
                step_on(sim);
            }
            const double rate = 9.81 * n * n / std::pow(0.5, 4.0 / 3);
            const double expected = 2 / (1 + 2 * rate * sim.clock.time);
            const double part = 0.4 * spacing / 0.5;
            EXPECT_NEAR(mean_velocity(sim), expected, part * (2 - expected)) << spacing << " " << n;
            const double taken = 500 * (2 - mean_velocity(sim)); // kg/m of water
            EXPECT_NEAR(before - sim.conservation.wall_impulse.x(), taken, 1e-9 * taken);
        }
    }
}

// A flume with smooth sides, which repeats itself along x, in a domain that is wider. In half of
// the draws a smooth wall splits it. `way`: of its lower corner along y [m].
struct Flume {
    double dp = 0.05;
    double length = 0.8, width = 0.4; // [m]
    double rows = 8;                  // depth / dp
    double way = 0, beyond = 0.5;     // of the domain beyond its sides [m]
    double manning = 0.05;
    bool split = false;
};

std::string text_of(const Flume& f)
{
    const double depth = f.rows * f.dp;
    const auto wall = [&](const char* more, double low, double high, double bottom, double top) {
        return fmt::format("[[wall]]\nshape = \"box\"\nmin = [-1, {}, {}]\nmax = [{}, {}, {}]\n{}",
                           low, bottom, f.length + 1, high, top, more);
    };
    const double low = f.way;
    const double high = low + f.width;
    const double far = 4 * f.dp;
    std::string text = fmt::format(
        "[time]\nend = 10\n[particles]\nspacing = {}\n[domain]\nmin = [0, {}, -0.5]\n"
        "max = [{}, {}, 1]\nperiodic = [\"x\"]\n[fluid]\n[[fluid.block]]\nshape = \"box\"\n"
        "min = [0, {}, 0]\nmax = [{}, {}, {}]\nvelocity = [1, 0, 0]\n",
        f.dp, low - f.beyond, f.length, high + f.beyond, low, f.length, high, depth);
    text += wall(fmt::format("manning = {}\n", f.manning).c_str(), low - far, high + far, -far, 0);
    text += wall("", low - far, low, -far, 2 * depth) + wall("", high, high + far, -far, 2 * depth);
    if (f.split) {
        const double middle = low + 2 * f.dp * std::floor(f.width / f.dp / 4);
        text += wall("", middle, middle + 4 * f.dp, -far, 2 * depth);
    }
    return text;
}

// Neither the sides nor the edge of the domain, which cut the columns, change the friction:
// du/dt = -g n^2 u^2 / h^(4/3). With the depth of whole columns 1.00 to 1.18 of it.
TEST(BedFriction, DoesNotDependOnWhatCutsTheColumns)
{
    Dice dice(7);
    for (int k = 0; k < number_from("HYORYU_DRAWS", 8); ++k) {
        Flume f{.dp = k % 2 == 0 ? 0.05 : 0.04};
        f.length = f.dp * (12 + dice.below(9));
        f.width = f.dp * (8 + dice.below(9));
        f.way = dice.between(-1, 1);
        f.beyond = dice.between(6, 10) * f.dp;
        f.split = k % 4 == 3;
        f.width += f.split ? 8 * f.dp : 0;
        const std::string text = text_of(f);
        SCOPED_TRACE(text);
        Simulation sim = make(text);
        while (sim.clock.time < 0.5) {
            step_on(sim);
        }
        const double rate = 9.81 * f.manning * f.manning / std::pow(8 * f.dp, 4.0 / 3);
        const double lost = 1 - 1 / (1 + rate * sim.clock.time);
        EXPECT_NEAR((1 - mean_velocity(sim)) / lost, 1, 0.01);
    }
}

// Widths and depths that miss the lattice. Known to fail: there a smooth flume slows down, too, by
// up to 1.2 times what the friction takes (a width of 7.3 spacings); so this is what the roughness
// adds. In eight other draws it was 0.85 to 1.04 of theory, with the depth of whole columns 0.90 to
// 1.18.
TEST(BedFriction, AddsNearlyManningsOffTheLattice)
{
    Dice dice(9);
    for (int k = 0; k < number_from("HYORYU_DRAWS", 4); ++k) {
        Flume f{.dp = k % 2 == 0 ? 0.05 : 0.04};
        f.length = f.dp * (12 + dice.below(9));
        f.width = f.dp * dice.between(5, 14);
        f.rows = dice.between(5, 10);
        f.way = dice.between(-1, 1);
        f.beyond = dice.between(6, 10) * f.dp;
        const double manning = f.manning;
        std::array<double, 2> speed{};
        double time = 0;
        for (const bool rough : {false, true}) {
            f.manning = rough ? manning : 0;
            SCOPED_TRACE(text_of(f));
            Simulation sim = make(text_of(f));
            while (sim.clock.time < 0.5) {
                step_on(sim);
            }
            time = sim.clock.time;
            speed[rough ? 1 : 0] = mean_velocity(sim);
        }
        const double rate = 9.81 * manning * manning / std::pow(f.rows * f.dp, 4.0 / 3);
        const double lost = 1 - 1 / (1 + rate * time);
        EXPECT_NEAR((speed[0] - speed[1]) / lost, 1, 0.2) << text_of(f);
    }
}

// A dam breaks over a rough bed in space.
const std::string dam = R"(
[time]
end = 10.0
[particles]
spacing = 0.08
precision = "double"
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.8, 0.64, 0.64]
[[wall]]
name = "basin"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [2.4, 0.64, 1.2]
open = ["+z"]
manning = 0.04
[[wall]]
name = "block"
shape = "box"
min = [1.6, 0.2, -0.4]
max = [1.9, 0.4, 0.8]
manning = 0.02
)";

TEST(BedFriction, AnyNumberOfThreadsAndARestartGiveTheSameBits)
{
    set_threads(1);
    Simulation one = make(dam);
    advance(one, 60);
    set_threads(3);
    Simulation three = make(dam);
    advance(three, 40);
    const Snapshot middle = save(three);
    advance(three, 20);
    expect_same_bits(save(one), save(three));
    Simulation again = make_blank(dam);
    restore(again, middle);
    advance(again, 20);
    expect_same_bits(save(one), save(again));
    EXPECT_LT(one.conservation.worst_closure, closes);
    set_threads(0);
}

TEST(BedFriction, ARoughBedIsSlowerAndASmoothOneHasNoMemory)
{
    Simulation rough = make(dam);
    Simulation smooth = make(dam, {"wall[0].manning=0", "wall[1].manning=0"});
    EXPECT_TRUE(smooth.bed.walls.empty());
    EXPECT_TRUE(rough.plan.runs("bed_friction"));
    EXPECT_FALSE(smooth.plan.runs("bed_friction"));
    while (rough.clock.time < 0.4) {
        step_on(rough);
    }
    while (smooth.clock.time < 0.4) {
        step_on(smooth);
    }
    EXPECT_EQ(smooth.bed.particles.capacity(), 0u);
    EXPECT_EQ(smooth.bed.speeds.capacity(), 0u);
    EXPECT_LT(mean_velocity(rough), 0.99 * mean_velocity(smooth));
    EXPECT_GT(mean_velocity(rough), 0.5 * mean_velocity(smooth));
}

TEST(BedFriction, RoughnessThatHasNoMeaningIsRefused)
{
    const auto fault = [](const std::string& text, const std::vector<std::string>& overrides) {
        try {
            parse_case(text, "case.toml", overrides);
        } catch (const CaseError& error) {
            return std::string(error.what());
        }
        return std::string("none");
    };
    EXPECT_EQ(fault(dam, {}), "none");
    EXPECT_NE(fault(dam, {"fluid.walls=\"no_slip\""}).find("needs fluid that slips"),
              std::string::npos);
    EXPECT_NE(fault(dam, {"wall[0].manning=-1"}).find("out of range"), std::string::npos);
    EXPECT_NE(fault(dam, {"wall[0].manning=33"}).find("at most 1 s/m^(1/3)"), std::string::npos);
    EXPECT_NE(
        fault("[time]\nend = 1\n[particles]\nspacing = 0.1\n[[wall]]\nshape = \"plane\"\n"
              "manning = 0.02\n[[body]]\nshape = \"sphere\"\nradius = 1\ndensity = 500\nposition "
              "= [0, 0, 2]\n",
              {})
            .find("has no meaning without a fluid"),
        std::string::npos);
}

} // namespace
} // namespace hyoryu::test_bed_friction
