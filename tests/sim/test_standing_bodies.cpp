// SPDX-License-Identifier: MIT
// Bodies that stand on the ground in still water: the force of the water on their sides is that of
// the pressure down to the ground.
#include "hyoryu/sim/gauges.hpp"

#include "dice.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace hyoryu::test_standing_bodies {
namespace {

constexpr double rho = 1000, g = 9.81;

// A heavy body between two levels of water, in a tank that does not fit the lattice; lengths in
// spacings.
struct Dam {
    double dp = 0.05;
    double high = 10, low = 0; // water on its two sides
    double place = 12;         // of its face
    double thick = 8;
    double width = 0; // 0: two dimensions
    bool sealed = false;

    std::string block(double from, double to, double level) const
    {
        return fmt::format("[[fluid.block]]\nshape = \"box\"\nmin = [{}, 0, 0]\n"
                           "max = [{}, {}, {}]\n",
                           from * dp, to * dp, width * dp, level * dp);
    }
    std::string gauge(const char* name, double x) const
    {
        return fmt::format("[[gauge]]\nname = \"{}\"\ntype = \"pressure\"\nat = [{}, {}, 0]\n",
                           name, x * dp, width / 2 * dp);
    }
    std::string text() const
    {
        const double end = place + thick;
        const double length = end + 12;
        const double across = width > 0 ? width * dp : 1;
        const std::string body = fmt::format(
            "[[body]]\nname = \"dam\"\nshape = \"box\"\nsize = [{}, {}, {}]\nfixed = true\n"
            "density = 3000\nposition = [{}, {}, {}]\nstands = \"{}\"\n",
            thick * dp, across, 18 * dp, (place + end) / 2 * dp, width / 2 * dp, 9 * dp,
            sealed ? "sealed" : "open");
        return fmt::format("dimensions = {}\n[time]\nend = 99\n[particles]\nspacing = {}\n[fluid]\n"
                           "[[wall]]\nshape = \"basin\"\nmin = [0, 0, 0]\nmax = [{}, {}, {}]\n"
                           "open = [\"+z\"]\n",
                           width > 0 ? 3 : 2, dp, length * dp, width * dp, 20 * dp) +
               block(0, place, high) + (low > 0 ? block(end, length, low) : "") + body +
               gauge("high", place / 3) + gauge("low", (end + 2 * length) / 3);
    }
};

// The force less that of the pressures that gauges on the ground read, in spacings of height.
double mean_error(const Dam& dam)
{
    Simulation sim = make(dam.text());
    const double settled = std::sqrt(dam.high * dam.dp / g);
    double force = 0;
    double high = 0;
    double low = 0;
    int steps = 0;
    while (sim.clock.time < 8 * settled) {
        step_on(sim);
        if (sim.clock.time > 3 * settled) {
            const std::vector<double> row = read_gauges(sim);
            force += sim.loads.bodies.at(0).force.x();
            high += row.at(0);
            low += std::isnan(row.at(1)) ? 0 : row.at(1);
            ++steps;
        }
    }
    const double across = dam.width > 0 ? dam.width * dam.dp : 1;
    const double exact = across * (sq(high / steps) - sq(low / steps)) / (2 * rho * g);
    return (force / steps - exact) / (across * high / steps * dam.dp);
}

Dam drawn_dam(Dice& dice, int n)
{
    Dam dam;
    dam.dp = n % 2 == 0 ? 0.05 : 0.02;
    dam.width = n >= 12 ? 6 : 0;
    dam.high = dice.between(8, 15);
    dam.low = dice.chance(0.5) ? 0 : dice.between(2, 5);
    dam.place = dice.between(10, 14);
    dam.thick = dice.between(5, 9);
    dam.sealed = dice.chance(0.5);
    return dam;
}

std::string told(const Dam& dam, int n)
{
    return fmt::format("draw {}: {} and {} spacings of water, face at {}, {} thick, {}", n,
                       dam.high, dam.low, dam.place, dam.thick, dam.sealed ? "sealed" : "open");
}

// In a tank that fits the lattice. With what the films under the body push along the joint up to
// 0.25 spacings of height; without the films between the body and the ground before it 0.27 too
// few.
TEST(StandingBodies, HaveTheForceOfThePressureDownToTheGround)
{
    Dice dice(95);
    for (int n = 0; n < 12; ++n) {
        Dam dam = drawn_dam(dice, n);
        for (double* length : {&dam.high, &dam.low, &dam.place, &dam.thick}) {
            *length = std::floor(*length);
        }
        EXPECT_NEAR(mean_error(dam), 0, 0.08) << told(dam, n);
    }
}

// Where the columns of the body and of the ground are out of line, the two corners before and under
// the body are no mirror images: measured up to 0.27, 0.1 in the mean of squares.
TEST(StandingBodies, HaveTheForceOnAnyLattice)
{
    Dice dice(95);
    double squares = 0;
    for (int n = 0; n < 14; ++n) {
        const Dam dam = drawn_dam(dice, n);
        const double error = mean_error(dam);
        EXPECT_NEAR(error, 0, 0.3) << told(dam, n);
        squares += sq(error) / 14;
    }
    EXPECT_LT(std::sqrt(squares), 0.16);
}

} // namespace
} // namespace hyoryu::test_standing_bodies
