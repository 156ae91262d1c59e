// SPDX-License-Identifier: MIT
// Walls that reach into other walls which move alike: slabs, kerbs and piers in a floor.
#include "hyoryu/sim/gauges.hpp"

#include "dice.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

namespace hyoryu::test_embedded_walls {
namespace {

constexpr double rho = 1000, g = 9.81;

// A slab in the floor of a tank, in two dimensions; lengths in spacings.
struct Slab {
    double dp = 0.02; // [m]
    double top = 0;   // above the floor
    double wide = 0;
    double middle = 0; // along x
    double deep = 0;   // below its top
    int ground = 0;    // the floor: 0: of a basin, 1: a box, 2: a plane
    bool is_first = false;

    static constexpr double length = 32, depth = 12; // of the water

    std::string text() const
    {
        const double side = 6 * dp;
        const std::string water =
            fmt::format("min = [0, 0, 0]\nmax = [{}, 0, {}]\n", length * dp, depth * dp);
        const std::string tank = fmt::format(
            "[[wall]]\nname = \"tank\"\nshape = \"basin\"\nmin = [0, 0, {}]\n"
            "max = [{}, 0, {}]\nopen = [\"+z\"{}]\n",
            ground == 0 ? 0 : -side, length * dp, (depth + 6) * dp, ground == 0 ? "" : ", \"-z\"");
        const std::string box =
            fmt::format("[[wall]]\nname = \"floor\"\nshape = \"box\"\nmin = [{}, 0, {}]\n"
                        "max = [{}, 0, 0]\n",
                        -side, -side, length * dp + side);
        const std::string plane = "[[wall]]\nname = \"floor\"\nshape = \"plane\"\n"
                                  "point = [0, 0, 0]\nnormal = [0, 0, 1]\n";
        const std::string slab =
            fmt::format("[[wall]]\nname = \"slab\"\nshape = \"box\"\nsize = [{}, 0, {}]\n"
                        "position = [{}, 0, {}]\n",
                        wide * dp, deep * dp, middle * dp, (top - deep / 2) * dp);
        const std::string floor = ground == 0 ? "" : (ground == 1 ? box : plane);
        return fmt::format("dimensions = 2\n[time]\nend = 9\n[particles]\nspacing = {}\n[fluid]\n"
                           "density = {}\n[[fluid.block]]\nshape = \"box\"\n{}",
                           dp, rho, water) +
               (is_first ? slab + tank + floor : tank + floor + slab) +
               "[[gauge]]\nname = \"f\"\ntype = \"force\"\non = \"slab\"\n";
    }
};

Slab drawn_slab(Dice& dice)
{
    Slab slab;
    slab.dp = dice.chance(0.5) ? 0.02 : 0.05;
    slab.top = dice.between(0.1, 3);
    slab.wide = dice.between(8, 16);
    slab.middle = Slab::length / 2 + dice.between(-1, 1);
    slab.deep = slab.top + dice.between(2.5, 5);
    slab.ground = dice.below(3);
    slab.is_first = dice.chance(0.5);
    return slab;
}

// The force on the slab, by the weight of the water above it, averaged over some time after the
// first motion of the water.
double share_of_weight(const Slab& slab)
{
    Simulation sim = make(slab.text());
    const double settled = std::sqrt(Slab::depth * slab.dp / g);
    double sum = 0;
    int steps = 0;
    while (sim.clock.time < 3 * settled) {
        step_on(sim);
        if (sim.clock.time > settled) {
            sum -= read_gauges(sim).at(2);
            ++steps;
        }
    }
    const double above = (Slab::depth - slab.top) * slab.dp;
    return sum / steps / (rho * g * above * slab.wide * slab.dp);
}

// At each end a column of the slab gives way to one of the floor where less than 0.6 spacings are
// between them, or acts for it: 2 in `wide` at most, of either sign, so that the mean is nearer
// to 1. The water above the slab is known to a quarter of a layer. Where the floor kept its
// particles, the share was 0.16 to 0.22 for tops less than 0.6 spacings above it.
TEST(EmbeddedWalls, ASlabInTheFloorBearsTheWaterAboveIt)
{
    Dice dice(81);
    const int draws = number_from("HYORYU_DRAWS", 24);
    double mean = 0;
    for (int n = 0; n < draws; ++n) {
        const Slab slab = drawn_slab(dice);
        const double share = share_of_weight(slab);
        EXPECT_LT(std::abs(share - 1), 2 / slab.wide + 0.25 / Slab::depth)
            << "draw " << n << ": top " << slab.top << ", " << slab.wide << " wide, " << slab.deep
            << " deep, floor " << slab.ground << (slab.is_first ? ", slab first" : "");
        mean += share / draws;
    }
    EXPECT_NEAR(mean, 1, 0.05);
}

using Place = std::tuple<std::int64_t, std::int64_t, std::int64_t>;

// Wall of each place with a particle, to a thousandth of the spacing.
std::map<Place, std::string> owners(const std::string& text)
{
    const Scene scene = parse_case(text, "test.toml");
    const Filling filling = fill(scene);
    std::map<Place, std::string> all;
    for (std::size_t k = 0; k < filling.wall.size(); ++k) {
        const Vec3 p = 1000 / scene.spacing * filling.wall[k];
        all[{std::llround(p.x()), std::llround(p.y()), std::llround(p.z())}] =
            scene.walls[static_cast<std::size_t>(filling.wall_owner[k])].name;
    }
    return all;
}

// Only at the seams, where less than 0.6 spacings are left between the particles of two walls, does
// the order count, and where two ways out are of the same length: up to three of the particles of
// two rows of the slab, at each end of it.
TEST(EmbeddedWalls, TheOrderOfWallsCountsAtSeamsAlone)
{
    Dice dice(82);
    for (int n = 0; n < 30; ++n) {
        Slab slab = drawn_slab(dice);
        slab.is_first = false;
        const auto after = owners(slab.text());
        slab.is_first = true;
        const auto before = owners(slab.text());
        int unlike = 0;
        for (const auto& [place, wall] : after) {
            const auto found = before.find(place);
            unlike += found == before.end() || found->second != wall ? 1 : 0;
        }
        EXPECT_LE(unlike, 3 * slab.deep + slab.wide / 4 + 2)
            << "draw " << n << ": top " << slab.top << ", " << slab.wide << " wide";
    }
}

// A slab whose top is that of the floor, and a box that stands on it, change no particle.
TEST(EmbeddedWalls, WallsThatTouchKeepTheirParticles)
{
    Dice dice(83);
    for (int n = 0; n < 20; ++n) {
        Slab slab = drawn_slab(dice);
        slab.deep = slab.top; // it stands on the floor
        const std::string text = slab.text();
        const Scene scene = parse_case(text, "test.toml");
        std::map<std::string, std::size_t> together;
        for (const auto& [place, wall] : owners(text)) {
            ++together[wall];
        }
        Slab far = slab;
        far.top += 100;
        std::map<std::string, std::size_t> apart;
        for (const auto& [place, wall] : owners(far.text())) {
            ++apart[wall];
        }
        if (slab.top > 1.2) { // its own rows are farther than 0.6 spacings from those of the floor
            EXPECT_EQ(together["tank"], apart["tank"]) << n;
            EXPECT_EQ(together["slab"], apart["slab"]) << n;
        }
    }
}

} // namespace
} // namespace hyoryu::test_embedded_walls
