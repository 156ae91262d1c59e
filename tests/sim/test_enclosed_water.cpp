// SPDX-License-Identifier: MIT
// Water that solids enclose in two dimensions: a held slab on two piers under water at rest.
#include "hyoryu/sim/gauges.hpp"

#include "dice.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace hyoryu::test_enclosed_water {
namespace {

constexpr double spacing = 0.02;

// Lengths in spacings.
struct SlabOnPiers {
    double left, width, height, pier, raised;

    double level() const { return raised + height + 4; }

    std::string text() const
    {
        const auto wall = [&](double from) {
            return fmt::format("[[wall]]\nshape = \"box\"\nmin = [{}, 0, 0]\nmax = [{}, 0, {}]\n",
                               from * spacing, (from + pier) * spacing, raised * spacing);
        };
        const double across = std::round(left + width + 12) * spacing;
        return fmt::format(
            "dimensions = 2\n[time]\nend = 10\n[particles]\nspacing = {0}\n[fluid]\n"
            "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [{1}, 0, {2}]\n[[wall]]\n"
            "shape = \"basin\"\nmin = [0, 0, 0]\nmax = [{1}, 0, {3}]\nopen = [\"+z\"]\n{4}{5}"
            "[[body]]\nname = \"slab\"\nshape = \"box\"\nsize = [{6}, 0, {7}]\ndensity = 20000\n"
            "position = [{8}, 0, {9}]\nlocks = [\"x\", \"z\", \"ry\"]\n"
            "[[gauge]]\nname = \"on\"\ntype = \"force\"\non = \"slab\"\n",
            spacing, across, level() * spacing, 2 * level() * spacing, wall(left + 1),
            wall(left + width - 1 - pier), width * spacing, height * spacing,
            (left + width / 2) * spacing, (raised + height / 2) * spacing);
    }
};

// Mean force on the slab beyond that of Archimedes, in spacings of water over its width.
double excess(const SlabOnPiers& slab)
{
    Simulation sim = make(slab.text());
    double force = 0;
    int steps = 0;
    while (sim.clock.time < 1) {
        step_on(sim);
        if (sim.clock.time > 0.7) {
            force += read_gauges(sim).at(2);
            steps += 1;
        }
    }
    return force / steps / (9810 * slab.width * spacing * spacing) - slab.height;
}

TEST(EnclosedWater, UnderASlabThatFitsTheLatticeIsThatOfArchimedes)
{
    Dice dice(51);
    for (int n = 0; n < 3; ++n) {
        const auto whole = [&](double low, double high) {
            return std::round(dice.between(low, high));
        };
        const SlabOnPiers slab{12, whole(14, 24), whole(3, 6), whole(2, 4), whole(5, 9)};
        EXPECT_NEAR(excess(slab), 0, 0.15) << slab.text();
    }
}

// Known to be off: in its first steps the enclosed water fills the gaps beside surfaces that miss
// the lattice. Outside the surface falls for that, within the pressure, here by 1.5 to 3.2 spacings
// of water.
TEST(EnclosedWater, OffTheLatticeLosesPressure)
{
    Dice dice(52);
    for (int n = 0; n < 3; ++n) {
        const SlabOnPiers slab{dice.between(12, 13), dice.between(14, 24), dice.between(3, 6),
                               dice.between(2.5, 4), dice.between(5, 9)};
        EXPECT_NEAR(excess(slab), 0, 7) << slab.text();
    }
}

} // namespace
} // namespace hyoryu::test_enclosed_water
