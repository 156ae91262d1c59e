// SPDX-License-Identifier: MIT
// Light bodies of few spacings under a bore and under water, drawn at random.
#include "runs.hpp"

#include "dice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace hyoryu::test_light_bodies {
namespace {

// An empty container or a car, of one to three and a half spacings, before a bore.
std::string light_body_before_bore(std::mt19937& dice)
{
    const auto draw = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(dice);
    };
    const double height = draw(0.8, 2.6);
    const double spacing = height / draw(1.1, 3.5);
    const double depth = draw(3, 4);
    const double tank = draw(26, 34);
    const double width = draw(4, 7);
    const double density = draw(60, 200);
    return fmt::format(
        "dimensions = 2\n[time]\nend = 10\n[particles]\nspacing = {}\n[fluid]\n"
        "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [10, 0, {}]\n"
        "[[wall]]\nshape = \"basin\"\nmin = [0, 0, 0]\nmax = [{}, 0, 30]\nopen = [\"+z\"]\n"
        "[[body]]\nshape = \"box\"\nsize = [{}, 0, {}]\ndensity = {}\nposition = [{}, 0, {}]\n",
        spacing, depth, tank, width, height, density, draw(14, 21), height / 2 + 1e-4);
}

// Kinetic and potential energy of the water and of the first body, summed from the particles.
double energy(const Simulation& sim)
{
    const Body& body = sim.rigid.bodies[0];
    const Store& water = sim.fluid->particles.fluid;
    const double m = sim.fluid->parameters.mass;
    double sum = kinetic_energy(body) + 9.81 * body.mass.mass * body.position.z();
    for (Index row = 0; row < water.size(); ++row) {
        const Vec3 v = water[field::velocity][row];
        sum += m * (0.5 * v.squaredNorm() + 9.81 * water[field::position][row].z());
    }
    return sum;
}

// A bore presses a light body against a wall. What its joint presses with cannot have entered it
// faster than the water moves: the body is not thrown, and no energy comes of it. Summed here from
// the particles. Known to fail: with one to three spacings across a body the energy still rises, by
// 0.37 % in the mean of 320 draws, in 4 of them by more than 2 %, in 2 by more than 4 %, at most by
// 7.1 %. Which ones these are depends on the rounding, since a bore is chaotic: of 24 draws 3
// exceed 4 % once in 3,000 times. Without the inertia of the inflow the mean was 0.8 %; with the
// inflow of the speed before a step 2.2 and at most 17 %, and the body was thrown above the water.
TEST(LightBodies, AreNotThrownByABore)
{
    std::mt19937 dice(11);
    constexpr int draws = 24;
    double mean = 0;
    int thrown = 0;
    for (int k = 0; k < draws; ++k) {
        const std::string text = light_body_before_bore(dice);
        Simulation sim = make(text);
        const double start = energy(sim);
        double least = start;
        double most = 0;
        while (sim.clock.time < 5) {
            step_on(sim);
            const double now = energy(sim);
            least = std::min(least, now);
            most = std::max(most, now - least);
        }
        EXPECT_LE(most, 0.1 * start) << text;
        thrown += most > 0.04 * start ? 1 : 0;
        mean += most / start / draws;
    }
    EXPECT_LE(thrown, 2);
    EXPECT_LE(mean, 0.008);
}

// A plate of 0.4 to 1.2 % of the density of water, let go in still water of a basin; by its depth
// [m].
std::string plate_under_water(std::mt19937& dice, double depth)
{
    const auto draw = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(dice);
    };
    const double spacing = depth / draw(25, 35);
    const double thickness = spacing * draw(2.5, 3.5);
    const double width = depth * draw(0.5, 0.8);
    const double density = draw(4, 12);
    const double x = depth * draw(1.2, 1.8);
    const double z = depth - thickness / 2 - spacing * draw(2, 5);
    return fmt::format(
        "dimensions = 2\n[time]\nend = 10\n[particles]\nspacing = {}\n[fluid]\n"
        "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [{}, 0, {}]\n"
        "[[wall]]\nshape = \"basin\"\nmin = [0, 0, 0]\nmax = [{}, 0, {}]\nopen = [\"+z\"]\n"
        "[[body]]\nshape = \"box\"\nsize = [{}, 0, {}]\ndensity = {}\n"
        "position = [{}, 0, {}]\n",
        spacing, 3 * depth, depth, 3 * depth, 4 * depth, width, thickness, density, x, z);
}

// The water that must move with the plate is many times as heavy as the plate, so that explicit
// coupling limits the step. Nothing drives the flow: with either continuity energy never rises
// above that at the start by more than 1 %, for the compression of the start.
TEST(LightBodies, LetGoUnderWaterGainNoEnergy)
{
    std::mt19937 dice(5);
    for (int k = 0; k < number_from("HYORYU_DRAWS", 6); ++k) {
        const double depth = std::pow(10, std::uniform_real_distribution(-1.0, 1.0)(dice));
        const std::string text = plate_under_water(dice, depth);
        for (const char* continuity : {"plain", "paired"}) {
            Simulation sim = make(text, {fmt::format("fluid.wall_continuity={}", continuity)});
            const double start = energy(sim);
            double most = start;
            while (sim.clock.time < std::sqrt(depth / 9.81)) {
                step_on(sim);
                most = std::max(most, energy(sim));
            }
            EXPECT_LE(most, 1.01 * start) << continuity << "\n" << text;
        }
    }
}

// A light box in still water that can only slide, less than a spacing from a heavy box on each
// side: particles of the water stand in the gaps, between surfaces that close in on them. It stays.
// When a particle took an impulse in each of four rounds the box bounced off them ever faster: two
// of these draws reached 1.1 and 7 m/s.
TEST(LightBodies, StayBetweenBodiesLessThanASpacingAway)
{
    std::mt19937 dice(12);
    const auto draw = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(dice);
    };
    for (int k = 0; k < 12; ++k) {
        const double dp = k % 2 == 0 ? 0.02 : 0.0125;
        const double width = draw(6, 10) * dp;
        const double height = draw(4, 8) * dp;
        const double depth = std::round(draw(6, 13)) * dp;
        const double tank = 40 * dp + 3 * width;
        std::string text = fmt::format(
            "dimensions = 2\n[time]\nend = 10\n[particles]\nspacing = {}\n[fluid]\n"
            "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [{}, 0, {}]\n[[wall]]\n"
            "shape = \"basin\"\nmin = [0, 0, 0]\nmax = [{}, 0, 1]\nopen = [\"+z\"]\n",
            dp, tank, depth, tank);
        const auto add = [&](double place, double density, const char* locks) {
            text += fmt::format("[[body]]\nshape = \"box\"\nsize = [{}, 1, {}]\ndensity = {}\n"
                                "position = [{}, 0, {}]\nlocks = [{}]\n",
                                width, height, density, place, height / 2, locks);
        };
        add(tank / 2, draw(25, 60), R"("z", "ry")");
        add(tank / 2 - width - draw(0.1, 0.9) * dp, 2500, "");
        add(tank / 2 + width + draw(0.1, 0.9) * dp, 2500, "");
        SCOPED_TRACE(text);
        Simulation sim = make(text);
        double fastest = 0;
        while (sim.clock.time < 0.1) {
            step_on(sim);
            fastest = std::max(fastest, std::abs(sim.rigid.bodies[0].velocity.x()));
        }
        EXPECT_LT(fastest, 0.5); // 0.6 times sqrt(g D) of the shallowest
    }
}

} // namespace
} // namespace hyoryu::test_light_bodies
