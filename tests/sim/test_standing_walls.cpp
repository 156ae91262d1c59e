// SPDX-License-Identifier: MIT
// Walls that stand on the ground in still water: their force is that of the pressure down to the
// ground, which the particles of the ground beside their foot carry in part.
#include "hyoryu/sim/gauges.hpp"

#include "dice.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace hyoryu::test_standing_walls {
namespace {

constexpr double rho = 1000, g = 9.81;

enum class Ground { basin, plane, box };

// A wall between two levels of water; lengths in spacings.
struct Dam {
    double dp = 0.05;
    double high = 10, low = 0; // water on its two sides
    double place = 12;         // of its face
    double thick = 4;
    double foot = 0;  // below the ground
    double width = 0; // 0: two dimensions
    Ground ground = Ground::basin;
    bool is_first = false; // in the case file

    std::string block(double from, double to, double level) const
    {
        return fmt::format("[[fluid.block]]\nshape = \"box\"\nmin = [{}, 0, 0]\n"
                           "max = [{}, {}, {}]\n",
                           from * dp, to * dp, width * dp, level * dp);
    }
    std::string box(const char* name, double left, double right, double bottom, double top) const
    {
        return fmt::format("[[wall]]\nname = \"{}\"\nshape = \"box\"\nmin = [{}, {}, {}]\n"
                           "max = [{}, {}, {}]\n",
                           name, left * dp, -9 * dp, bottom * dp, right * dp, (width + 9) * dp,
                           top * dp);
    }
    std::string text() const
    {
        const double end = place + thick;
        const double length = end + 12;
        const std::string tank =
            fmt::format("[[wall]]\nname = \"tank\"\nshape = \"basin\"\nmin = [0, 0, {}]\n"
                        "max = [{}, {}, {}]\nopen = {}\n",
                        ground == Ground::basin ? 0 : -9 * dp, length * dp, width * dp, 16 * dp,
                        ground == Ground::basin ? "[\"+z\"]" : "[\"-z\", \"+z\"]");
        const std::string floor = ground == Ground::plane ? "[[wall]]\nshape = \"plane\"\n"
                                  : ground == Ground::box ? box("floor", -9, length + 9, -9, 0)
                                                          : "";
        const std::string dam = box("dam", place, end, -foot, 16);
        return fmt::format(
                   "dimensions = {}\n[time]\nend = 99\n[particles]\nspacing = {}\n[fluid]\n",
                   width > 0 ? 3 : 2, dp) +
               block(0, place, high) + (low > 0 ? block(end, length, low) : "") +
               (is_first ? dam + floor + tank : floor + tank + dam) +
               "[[gauge]]\nname = \"f\"\ntype = \"force\"\non = \"dam\"\n";
    }
};

double mean_force(const Dam& dam)
{
    Simulation sim = make(dam.text());
    const double settled = std::sqrt(dam.high * dam.dp / g);
    double sum = 0;
    int steps = 0;
    while (sim.clock.time < 6 * settled) {
        step_on(sim);
        if (sim.clock.time > 2 * settled) {
            sum += read_gauges(sim).at(0);
            ++steps;
        }
    }
    return sum / steps;
}

TEST(StandingWalls, HaveTheForceOfThePressureDownToTheGround)
{
    Dice dice(91);
    for (int n = 0; n < 14; ++n) {
        Dam dam;
        dam.dp = n % 2 == 0 ? 0.05 : 0.02;
        dam.width = n >= 12 ? 5 : 0;
        dam.high = 8 + dice.below(7);
        dam.low = dice.chance(0.5) ? 0 : 2 + dice.below(4);
        dam.place = 10 + dice.below(4);
        dam.thick = dice.between(3, 6);
        dam.foot = dice.chance(0.3) ? 0 : dice.between(0, 5);
        dam.ground = std::array{Ground::basin, Ground::plane, Ground::box}[at(dice.below(3))];
        dam.is_first = dice.chance(0.5);
        const double exact = 0.5 * rho * g * (sq(dam.high) - sq(dam.low)) * sq(dam.dp) *
                             (dam.width > 0 ? dam.width * dam.dp : 1);
        EXPECT_NEAR(mean_force(dam) / exact, 1, 0.02)
            << "draw " << n << ": " << dam.high << " and " << dam.low << " spacings of water, "
            << dam.thick << " thick, foot " << dam.foot << ", ground "
            << static_cast<int>(dam.ground) << (dam.is_first ? ", first" : "");
    }
}

// A thin wall before the dam has what pushes the ground before them, with a gauge or without.
TEST(StandingWalls, AGaugeReadsTheSameWhateverOtherGaugesThereAre)
{
    Dice dice(92);
    for (int n = 0; n < 4; ++n) {
        Dam dam{.high = 8.0 + dice.below(4), .thick = 8};
        dam.ground = std::array{Ground::basin, Ground::plane, Ground::box}[at(dice.below(3))];
        dam.foot = dice.chance(0.5) ? 0 : dice.between(0, 3);
        Dam before = dam;
        before.place -= dice.between(1.1, 2.4);
        const std::string skin = before.box("skin", before.place, dam.place, 0, 16);
        std::string text = dam.text() + skin;
        const std::string water = fmt::format("max = [{}", dam.place * dam.dp);
        text.replace(text.find(water), water.size(),
                     fmt::format("max = [{}", before.place * dam.dp));
        Simulation alone = make(text);
        Simulation all = make(text + "[[gauge]]\nname = \"s\"\ntype = \"force\"\non = \"skin\"\n"
                                     "[[gauge]]\nname = \"t\"\ntype = \"force\"\non = \"tank\"\n");
        advance(alone, 40);
        advance(all, 40);
        for (const std::size_t k : {0u, 1u, 2u}) {
            EXPECT_EQ(read_gauges(alone).at(k), read_gauges(all).at(k)) << "draw " << n;
        }
    }
}

} // namespace
} // namespace hyoryu::test_standing_walls
