// SPDX-License-Identifier: MIT
// Gauges at the sides of a domain that repeats itself.
#include "dice.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace hyoryu::test_gauge_seams {
namespace {

std::string gauge(const std::string& name, const std::string& rest)
{
    return "[[gauge]]\nname = \"" + name + "\"\n" + rest + "\n";
}

// A stream that repeats itself along x, and in space along y: at the seams as elsewhere. Densities
// are in single precision.
TEST(GaugeSeams, AUniformStreamHasItsFluxAtPeriodicSides)
{
    Dice dice(3);
    for (const int dimensions : {2, 3}) {
        const double width = dimensions == 3 ? 0.4 : 0;
        std::string text = fmt::format(
            "dimensions = {}\ngravity = [0, 0, 0]\n[time]\nend = 1\nstep = 0.001\n[particles]\n"
            "spacing = 0.02\n[domain]\nmin = [-0.3, 0, -1]\nmax = [0.5, {}, 2]\nperiodic = "
            "[\"x\"{}]\n[fluid]\n[[fluid.block]]\nshape = \"box\"\nmin = [-0.3, 0, 0]\n"
            "max = [0.5, {}, 0.5]\nvelocity = [2, 1, 0]\n",
            dimensions, width, dimensions == 3 ? ", \"y\"" : "", width);
        text = dimensions == 2 ? text.replace(text.find("[2, 1, 0]"), 9, "[2, 0, 0]") : text;
        const std::vector<double> places{-0.3,
                                         0.5,
                                         0.5 - 1e-9,
                                         dice.between(-0.3, -0.26),
                                         dice.between(0.46, 0.5),
                                         dice.between(-0.3, 0.5)};
        for (std::size_t k = 0; k < places.size(); ++k) {
            text += gauge(fmt::format("x{}", k),
                          fmt::format("type = \"flux\"\nat = [{}, 0, 0]", places[k]));
            text += dimensions == 2 ? ""
                                    : gauge(fmt::format("y{}", k),
                                            fmt::format("type = \"flux\"\nat = [0, {}, 0]\n"
                                                        "normal = [0, 1, 0]",
                                                        0.5 * (places[k] + 0.3)));
        }
        Simulation sim = make(text);
        advance(sim, 7);
        const std::vector<double> readings = next_gauge_row(sim);
        std::size_t column = 0;
        for (std::size_t k = 0; k < places.size(); ++k) {
            const double area = 0.5 * (dimensions == 3 ? width : 1);
            EXPECT_NEAR(readings[column++], 2 * area, 1e-5 * area) << places[k];
            if (dimensions == 3) {
                EXPECT_NEAR(readings[column++], 0.5 * 0.8, 1e-5) << places[k];
            }
        }
    }
}

} // namespace
} // namespace hyoryu::test_gauge_seams
