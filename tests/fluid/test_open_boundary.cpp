// SPDX-License-Identifier: MIT
// The flow that a carpet takes from what is asked for and what is measured inside, against the
// characteristics of the shallow-water equations.
#include "hyoryu/fluid/open_boundary.hpp"

#include "dice.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hyoryu::test_open_boundary {
namespace {

constexpr double g = 9.81;

StationFlow inside(double depth, double drift = 0)
{
    StationFlow flow;
    flow.depth = depth;
    flow.drift = drift;
    return flow;
}

// A uniform flow that goes on through the plane, above any ground: nothing is to change.
TEST(OpenBoundary, AUniformFlowGoesOn)
{
    Dice dice(1);
    for (int n = 0; n < 100; ++n) {
        const double bed = dice.between(-5, 5);
        const double h = dice.between(0.05, 3);
        const double u = dice.between(-0.99, 2.5) * std::sqrt(g * h);
        const AskedFlow asked{.level = bed + h, .velocity = u};
        const StationFlow flow = flow_at(asked, inside(h, u), {bed, bed}, g);
        EXPECT_NEAR(flow.velocity, u, 1e-12 * std::sqrt(g * h));
        EXPECT_NEAR(flow.level, bed + h, 1e-12);
        EXPECT_FALSE(flow.passes);
    }
}

// Whatever depth comes from inside: the invariant u + 2 c that enters is the one that is asked for,
// where the flow at the plane is subcritical in both directions.
TEST(OpenBoundary, TheIncomingInvariantIsTheOneAskedFor)
{
    Dice dice(2);
    int free = 0;
    for (int n = 0; n < 300; ++n) {
        const double h = dice.between(0.1, 2);
        const double u = dice.between(-0.9, 0.9) * std::sqrt(g * h);
        const double depth = h * dice.between(0.5, 1.6);
        const StationFlow flow = flow_at({.level = h, .velocity = u}, inside(depth), {0, 0}, g);
        const double c = std::sqrt(g * flow.level);
        EXPECT_LE(std::abs(flow.velocity), c * (1 + 1e-12)) << "at most critical";
        if (flow.velocity > -c * (1 - 1e-9) && flow.level == depth) {
            EXPECT_NEAR(flow.velocity + 2 * c, u + 2 * std::sqrt(g * h), 1e-12 * c);
            ++free;
        }
    }
    EXPECT_GT(free, 200);
}

TEST(OpenBoundary, ASupercriticalInflowDoesNotKnowTheInside)
{
    Dice dice(3);
    for (int n = 0; n < 100; ++n) {
        const double h = dice.between(0.05, 2);
        const double u = dice.between(1.01, 4) * std::sqrt(g * h);
        const StationFlow flow =
            flow_at({.level = h, .velocity = u}, inside(dice.between(0, 3)), {0, 0}, g);
        EXPECT_EQ(flow.velocity, u);
        EXPECT_EQ(flow.level, h);
    }
}

// The product of depth and velocity, at least at the critical depth (q^2/g)^(1/3) where it enters.
TEST(OpenBoundary, ADischargeEntersWhole)
{
    Dice dice(4);
    for (int n = 0; n < 100; ++n) {
        const double bed = dice.between(-1, 1);
        const double q = dice.between(0.01, 3);
        const double depth = dice.between(0, 2);
        const StationFlow flow = flow_at({.discharge = q}, inside(depth), {bed, bed}, g);
        EXPECT_NEAR((flow.level - bed) * flow.velocity, q, 1e-12 * q);
        EXPECT_GE(flow.level - bed, std::cbrt(q * q / g) * (1 - 1e-12));
    }
}

TEST(OpenBoundary, AFreeSideNeverLetsIn)
{
    Dice dice(5);
    for (int n = 0; n < 100; ++n) {
        const double depth = dice.between(0, 2);
        const double drift = dice.between(-6, 6);
        const StationFlow flow = flow_at({.free = true}, inside(depth, drift), {0, 0}, g);
        EXPECT_EQ(flow.velocity, std::min(drift, 0.0));
        EXPECT_EQ(flow.passes, depth > 0 && drift < -std::sqrt(g * depth));
    }
}

// A level alone is a simple wave into water at rest: u = 2 sqrt(g h) - 2 sqrt(g h0).
TEST(OpenBoundary, ALevelAloneIsASimpleWave)
{
    Dice dice(6);
    for (int n = 0; n < 100; ++n) {
        const double still = dice.between(0.2, 2);
        const double h = still * dice.between(0.8, 1.5);
        const StationFlow flow = flow_at({.level = h, .still = still}, inside(h), {0, 0}, g);
        EXPECT_NEAR(flow.velocity, 2 * (std::sqrt(g * h) - std::sqrt(g * still)),
                    1e-12 * std::sqrt(g * h));
    }
}

} // namespace
} // namespace hyoryu::test_open_boundary
