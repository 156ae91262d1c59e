// SPDX-License-Identifier: MIT
// Bodies that stand on the ground in still water: the force of the water on their sides is that of
// the pressure down to the ground.
#include "hyoryu/sim/simulation.hpp"

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
               block(0, place, high) + (low > 0 ? block(end, length, low) : "") + body;
    }
};

double mean_force(const Dam& dam)
{
    Simulation sim = make(dam.text());
    const double settled = std::sqrt(dam.high * dam.dp / g);
    double sum = 0;
    int steps = 0;
    while (sim.clock.time < 8 * settled) {
        step_on(sim);
        if (sim.clock.time > 3 * settled) {
            sum += sim.loads.bodies.at(0).force.x();
            ++steps;
        }
    }
    return sum / steps;
}

// 0.1 spacings of height: without the cut of the slip of films up to 0.25, by the place of the last
// column of water, and without the films between the body and the ground before it 0.27 too few.
TEST(StandingBodies, HaveTheForceOfThePressureDownToTheGround)
{
    Dice dice(95);
    for (int n = 0; n < 14; ++n) {
        Dam dam;
        dam.dp = n % 2 == 0 ? 0.05 : 0.02;
        dam.width = n >= 12 ? 6 : 0;
        dam.high = dice.between(8, 15);
        dam.low = dice.chance(0.5) ? 0 : dice.between(2, 5);
        dam.place = dice.between(10, 14);
        dam.thick = dice.between(5, 9);
        dam.sealed = dice.chance(0.5);
        const double unit =
            rho * g * dam.high * sq(dam.dp) * (dam.width > 0 ? dam.width * dam.dp : 1);
        const double exact = unit / dam.high * (sq(dam.high) - sq(dam.low)) / 2;
        EXPECT_NEAR((mean_force(dam) - exact) / unit, 0, 0.1)
            << "draw " << n << ": " << dam.high << " and " << dam.low
            << " spacings of water, face at " << dam.place << ", " << dam.thick << " thick"
            << (dam.sealed ? ", sealed" : "");
    }
}

} // namespace
} // namespace hyoryu::test_standing_bodies
