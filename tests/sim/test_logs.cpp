// SPDX-License-Identifier: MIT
// Logs that lie on the ground at random float off at their draft. HYORYU_PLACEMENTS=40 is the
// nightly size, with the fine spacing in space, HYORYU_SEED the first seed.
#include "placements.hpp"
#include "runs.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <numbers>

namespace hyoryu::test_logs {
namespace {

constexpr double water_density = 1000;

// A log on its side in a tank; it lies on a line, so that no joint is below it.
struct Log {
    int dimensions = 2;
    double spacing = 0.05;
    double radius = 0.2; // [m]
    double level = 0.3;  // [m]
    double place = 0;    // of its middle [m]

    // Of its cross-section below a depth [m2].
    double area(double depth) const
    {
        const double up = radius - depth;
        return sq(radius) * std::acos(up / radius) - up * std::sqrt(sq(radius) - sq(up));
    }
    std::string text(double draft) const
    {
        const bool flat = dimensions == 2;
        const double density = water_density * area(draft) / (std::numbers::pi * sq(radius));
        return fmt::format(
            "dimensions = {0}\n[time]\nend = 10.0\n[particles]\nspacing = {1}\n[fluid]\n"
            "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [{2}, 1.2, {3}]\n"
            "[[wall]]\nname = \"basin\"\nshape = \"basin\"\nmin = [0, 0, 0]\nmax = [{2}, 1.2, 2]\n"
            "open = [\"+z\"]\n[[body]]\nname = \"log\"\n{4}density = {5}\nposition = [{6}, {7}, "
            "{8}]\n",
            dimensions, spacing, flat ? 1.2 : 0.5, level,
            flat ? fmt::format("shape = \"sphere\"\nradius = {}\n", radius)
                 : fmt::format("shape = \"cylinder\"\nradius = {}\nlength = 0.3\n", radius),
            density, flat ? place : 0.25, flat ? 0 : place, radius);
    }
    // How far it has risen after a while, where its draft is so many spacings below the level [dp].
    double rise(double over) const
    {
        Simulation sim = make(text(level - over * spacing));
        while (sim.clock.time < 0.3) {
            step_on(sim);
        }
        return (sim.rigid.bodies[0].position.z() - radius) / spacing;
    }
};

// Water gets under it by itself: it floats off a spacing and a half above its draft, and not one
// below it. One spacing above it, one disc in four of the finer spacing rises by 0.06 spacings and
// settles again.
TEST(Logs, ALogOnItsSideFloatsOff)
{
    for_seeds(4, [](std::uint64_t seed) {
        Dice dice(seed);
        Log log;
        log.radius = dice.between(0.17, 0.25);
        log.place = dice.between(0.5, 0.7);
        log.level = dice.between(0.8, 1.5) * log.radius;
        for (const int dimensions : {2, 3}) {
            log.dimensions = dimensions;
            for (const double spacing : {0.05, 0.025}) {
                if (dimensions == 3 && spacing < 0.05 && number_from("HYORYU_PLACEMENTS", 4) <= 4) {
                    continue;
                }
                log.spacing = spacing;
                EXPECT_GT(log.rise(1.5), 0.25) << dimensions << " dimensions, spacing " << spacing;
                EXPECT_LT(log.rise(-1), 0.05) << dimensions << " dimensions, spacing " << spacing;
            }
        }
    });
}

} // namespace
} // namespace hyoryu::test_logs
