// SPDX-License-Identifier: MIT
// Paths of pistons and gates, against numbers computed elsewhere, and their keys.
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/piston.hpp"

#include "hyoryu/core/error.hpp"

#include "dice.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

namespace hyoryu {
namespace {

constexpr double g = 9.81;
constexpr double pi = std::numbers::pi;

Scene read(const std::string& motion)
{
    return parse_case("dimensions = 2\n[time]\nend = 12\n[particles]\nspacing = 0.05\n[fluid]\n"
                      "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [4, 0, 0.66]\n"
                      "[[wall]]\nname = \"paddle\"\nshape = \"box\"\nmin = [-0.3, 0, 0]\nmax = [0, "
                      "0, 1]\n[wall.motion]\n" +
                          motion,
                      "case.toml");
}

std::string fault_of(const std::string& motion)
{
    try {
        read(motion);
    } catch (const CaseError& error) {
        return error.what();
    }
    return {};
}

TEST(Waves, SolitaryPistonsHaveTheStrokesOfBothTheories)
{
    const double shares = std::tanh(3.80); // where the path is cut
    const auto stroke = [](SolitaryTheory theory) {
        return solitary_piston(0.06, 0.3, g, theory).places.back().x();
    };
    EXPECT_NEAR(stroke(SolitaryTheory::boussinesq) / shares, 0.3098, 1e-4);
    EXPECT_NEAR(stroke(SolitaryTheory::rayleigh) / shares, 0.3394, 1e-4);
}

// The paddle moves with the mean speed c eta / (d + eta) of the water behind it, eta = H sech^2 of
// the phase at the paddle, whatever the height.
TEST(Waves, SolitaryPistonsFollowTheirEquationOfMotion)
{
    Dice dice(4);
    for (int n = 0; n < 20; ++n) {
        const double d = dice.between(0.1, 3);
        const double H = dice.between(0.05, 0.6) * d;
        const bool rayleigh = dice.chance(0.5);
        const double k = std::sqrt(3 * H / (4 * d * d * (rayleigh ? d + H : d)));
        const double c = std::sqrt(g * (d + H));
        const Motion motion = solitary_piston(
            H, d, g, rayleigh ? SolitaryTheory::rayleigh : SolitaryTheory::boussinesq);
        const double middle = (motion.times.front() + motion.times.back()) / 2;
        const double centre = motion.places.back().x() / 2;
        for (const double share : {0.3, 0.45, 0.5, 0.6, 0.75}) {
            const double t = share * motion.times.back();
            const double x = displacement(motion, t).x();
            const double phase = k * (c * (t - middle) - (x - centre));
            const double eta = H / std::pow(std::cosh(phase), 2);
            EXPECT_NEAR(velocity(motion, t).x(), c * eta / (d + eta), 2e-3 * c * H / d);
            EXPECT_NEAR(asked_level(motion, t), eta, 2e-3 * H);
        }
    }
}

// d = 0.66 m, T = 2 s, H = 0.10 m.
TEST(Waves, RegularPistonsHaveTheNumbersOfMadsen)
{
    const WaveTrain wave{.height = 0.10, .period = 2, .depth = 0.66, .order = 2, .ramp = 0};
    EXPECT_NEAR(2 * pi / wave_number(2, 0.66, g), 4.524, 5e-4);
    EXPECT_NEAR(stroke_of(wave, g).first, 0.1106, 5e-5);
    EXPECT_NEAR(stroke_of(wave, g).second, 0.73e-3, 5e-6);
    const Motion motion = regular_piston(wave, g, 10);
    for (const double t : {0.3, 1.1, 4.77, 9.2}) {
        const double x = 0.1106 / 2 * std::sin(pi * t) + 0.73e-3 * std::sin(2 * pi * t);
        EXPECT_NEAR(displacement(motion, t).x(), x, 1e-4); // rounding of the numbers above
    }
}

// w^2 = g k tanh(k d) in deep and shallow water, by its own residual.
TEST(Waves, WaveNumbersSolveTheDispersionRelation)
{
    Dice dice(9);
    for (int n = 0; n < 100; ++n) {
        const double T = std::exp(dice.between(-2, 4));
        const double d = std::exp(dice.between(-4, 3));
        const double k = wave_number(T, d, g);
        EXPECT_NEAR(g * k * std::tanh(k * d) / std::pow(2 * pi / T, 2), 1, 1e-10);
    }
}

TEST(Waves, GatesRiseWithTheSpeedOfTheCase)
{
    const Scene scene = read("lift = { start = 0.5, speed = 2.0 }\n");
    const Motion& motion = scene.walls[0].motion;
    EXPECT_EQ(displacement(motion, 0.5), Vec3(0, 0, 0));
    EXPECT_NEAR(displacement(motion, 3.5).z(), 2 * (3.5 - 0.5) - 0.025, 0.01);
    EXPECT_NEAR(velocity(motion, 3).z(), 2, 1e-6);
}

TEST(Waves, MotionsReadBackBitByBit)
{
    for (const char* motion :
         {"piston = { height = 0.1, period = 2, depth = 0.66 }\nabsorb = true\n",
          "piston = { solitary_height = 0.1, depth = 0.66, theory = \"rayleigh\" }\n",
          "absorb = true\ndepth = 0.66\n", "lift = { start = 1, speed = 1 }\n"}) {
        const std::string resolved = to_toml(read(motion));
        EXPECT_EQ(to_toml(parse_case(resolved, "case.toml")), resolved) << motion;
    }
}

TEST(Waves, MistakesAreToldWithTheirReason)
{
    EXPECT_NE(fault_of("piston = { height = 0.3, period = 8, depth = 0.4 }").find("8 pi^2 / 3"),
              std::string::npos);
    EXPECT_EQ(fault_of("piston = { height = 0.3, period = 8, depth = 0.4, order = 1 }"), "");
    EXPECT_NE(fault_of("piston = { depth = 0.4 }").find("is missing"), std::string::npos);
    EXPECT_NE(fault_of("piston = { height = 0.1, solitary_height = 0.1, period = 2, depth = 1 }")
                  .find("not both"),
              std::string::npos);
    EXPECT_NE(fault_of("velocity = [1, 0, 0]\nabsorb = true\ndepth = 1").find("waves that"),
              std::string::npos);
    EXPECT_NE(fault_of("absorb = true").find("depth"), std::string::npos);
    EXPECT_NE(fault_of("lift = { start = 1, speed = 1 }\nvelocity = [1, 0, 0]").find("give one of"),
              std::string::npos);
}

} // namespace
} // namespace hyoryu
