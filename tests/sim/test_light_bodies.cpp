// SPDX-License-Identifier: MIT
// Light bodies of few spacings under a bore, drawn at random.
#include "runs.hpp"

#include <fmt/format.h>

#include <algorithm>
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
    return fmt::format(
        "dimensions = 2\n[time]\nend = 10\n[particles]\nspacing = {}\n[fluid]\n"
        "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [10, 0, {}]\n"
        "[[wall]]\nshape = \"basin\"\nmin = [0, 0, 0]\nmax = [{}, 0, 30]\nopen = [\"+z\"]\n"
        "[[body]]\nshape = \"box\"\nsize = [{}, 0, {}]\ndensity = {}\nposition = [{}, 0, {}]\n",
        height / draw(1.1, 3.5), draw(3, 4), draw(26, 34), draw(4, 7), height, draw(60, 200),
        draw(14, 21), height / 2 + 1e-4);
}

// A bore presses a light body against a wall. What its joint presses with cannot have entered it
// faster than the water moves: the body is not thrown, and no energy comes of it. Summed here from
// the particles. Known to fail: with one to three spacings across a body the energy still rises, by
// 0.8 % in the mean of 40 other draws, by 4.3 % at most. With the inflow of the speed before a step
// it was 2.2 and 17 %, and the body was thrown above the water.
TEST(LightBodies, AreNotThrownByABore)
{
    std::mt19937 dice(11);
    constexpr int draws = 24;
    double mean = 0;
    for (int k = 0; k < draws; ++k) {
        const std::string text = light_body_before_bore(dice);
        Simulation sim = make(text);
        const Body& body = sim.rigid.bodies[0];
        const Store& water = sim.fluid->particles.fluid;
        const auto energy = [&] {
            const double m = sim.fluid->parameters.mass;
            double sum = kinetic_energy(body) + 9.81 * body.mass.mass * body.position.z();
            for (Index row = 0; row < water.size(); ++row) {
                const Vec3 v = water[field::velocity][row];
                sum += m * (0.5 * v.squaredNorm() + 9.81 * water[field::position][row].z());
            }
            return sum;
        };
        const double start = energy();
        double least = start;
        double most = 0;
        while (sim.clock.time < 5) {
            step_on(sim);
            const double now = energy();
            least = std::min(least, now);
            most = std::max(most, now - least);
        }
        EXPECT_LE(most, 0.06 * start) << text;
        mean += most / start / draws;
    }
    EXPECT_LE(mean, 0.012);
}

} // namespace
} // namespace hyoryu::test_light_bodies
