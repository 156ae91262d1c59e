// SPDX-License-Identifier: MIT
// Paths of pistons and gates, against numbers computed elsewhere, and their keys.
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/piston.hpp"
#include "hyoryu/scene/plan.hpp"

#include "hyoryu/core/error.hpp"

#include "dice.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

namespace hyoryu::test_waves {
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

// z = a t^2/2 up to half a spacing, then at the speed of the case to the end of the run, whatever
// that end is: the path of an extended run is the same.
TEST(Waves, GatesRiseEvenlyForAnySpeedSpacingAndEnd)
{
    Dice dice(12);
    for (int n = 0; n < 100; ++n) {
        const double start = dice.between(0, 2);
        const double speed = std::exp(dice.between(-4, 3));
        const double runway = std::exp(dice.between(-8, 0));
        const double end = std::exp(dice.between(-2, 6));
        const Motion motion = lifted_gate(start, speed, runway, end);
        const Motion longer = lifted_gate(start, speed, runway, 2 * end);
        const double gains = 2 * runway / speed;
        for (int k = 0; k <= 50; ++k) {
            const double t = start + (k < 25 ? k / 25.0 * gains : (k - 25) / 25.0 * end);
            const double on = t - start;
            const double z =
                on < gains ? speed * on * on / (2 * gains) : runway + speed * (on - gains);
            EXPECT_NEAR(displacement(motion, t).z(), z, 0.01 * runway + 1e-9 * z) << k;
            EXPECT_EQ(displacement(motion, t), displacement(longer, t));
            if (on > 1.2 * gains) {
                EXPECT_NEAR(velocity(motion, t).z(), speed, 1e-6 * speed);
            }
        }
    }
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
    EXPECT_NE(fault_of("absorb = true\ndepth = 1\nlevels = [0, 0.1]")
                  .find("has no meaning without `times` and `places`"),
              std::string::npos);
    EXPECT_NE(fault_of("lift = { start = 1, speed = 1 }\nvelocity = [1, 0, 0]").find("give one of"),
              std::string::npos);
}

TEST(Waves, AMistakenHeightSpeaksForItselfAlone)
{
    const std::string told = fault_of("piston = { height = 0, period = 2, depth = 0.66 }");
    EXPECT_NE(told.find("piston.height"), std::string::npos) << told;
    EXPECT_EQ(told.find("no meaning"), std::string::npos) << told;
}

std::string warnings_of(const Scene& scene)
{
    std::string all;
    for (const Diagnostic& warning : make_plan(scene, fill(scene)).warnings) {
        all += warning.key + ": " + warning.what + "\n";
    }
    return all;
}

// On both sides of the limits of McCowan (0.78 of the depth) and Miche (0.142 tanh(kd) of the
// length), with k of the dispersion relation solved by bisection.
TEST(Waves, WavesThatBreakAtOnceAreWarnedOf)
{
    Dice dice(31);
    for (int n = 0; n < 12; ++n) {
        const double off = dice.chance(0.5) ? 1.03 : 0.97;
        const std::string solitary = warnings_of(read(
            fmt::format("piston = {{ solitary_height = {}, depth = 0.66 }}", off * 0.78 * 0.66)));
        EXPECT_EQ(solitary.find("breaks immediately") != std::string::npos, off > 1) << solitary;
        const double period = dice.between(0.5, 1.2);
        double low = 0, high = 1000;
        for (int k = 0; k < 100; ++k) {
            const double middle = (low + high) / 2;
            const bool short_of = g * middle * std::tanh(0.66 * middle) < sq(2 * pi / period);
            (short_of ? low : high) = middle;
        }
        const double most = 0.142 * std::tanh(0.66 * low) * 2 * pi / low;
        const std::string regular = warnings_of(
            read(fmt::format("piston = {{ height = {}, period = {}, depth = 0.66, order = 1 }}",
                             off * most, period)));
        EXPECT_EQ(regular.find("breaks immediately") != std::string::npos, off > 1)
            << period << " s\n"
            << regular;
    }
}

TEST(Waves, DepthsThatAreNotThoseOfTheWaterAreWarnedOf)
{
    for (const double depth : {0.4, 0.6, 0.66, 0.7, 1.2}) {
        for (const char* motion :
             {"piston = {{ solitary_height = 0.05, depth = {} }}", "absorb = true\ndepth = {}"}) {
            const std::string told = warnings_of(read(fmt::format(fmt::runtime(motion), depth)));
            // the lattice rounds the water to its spacing of 0.05 m
            EXPECT_EQ(told.find("water in front of") != std::string::npos,
                      std::abs(depth - 0.66) > 0.07)
                << depth << "\n"
                << told;
        }
    }
    const std::string behind =
        warnings_of(read("piston = { solitary_height = 0.05, depth = 0.66 }\n[[wall]]\nname = "
                         "\"basin\"\nshape = \"basin\"\nmin = [0, 0, 0]\nmax = [4, 0, 1]\n"));
    EXPECT_EQ(behind.find("no water"), std::string::npos) << behind;
}

// A sponge has a depth or a rate; without gravity a depth gives no rate, and it would damp nothing.
TEST(Waves, SpongesHaveADepthOrARate)
{
    const auto fault = [](const std::string& gravity, const std::string& keys) -> std::string {
        try {
            parse_case("dimensions = 2\n" + gravity +
                           "[time]\nend = 1\n[particles]\nspacing = 0.05\n[fluid]\n"
                           "sound_speed = 20\n[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\n"
                           "max = [1, 0, 1]\n[[sponge]]\nmin = [0, 0, 0]\nmax = [1, 0, 1]\n" +
                           keys,
                       "case.toml");
        } catch (const CaseError& error) {
            return error.what();
        }
        return {};
    };
    const std::string weightless = "gravity = [0, 0, 0]\n";
    EXPECT_EQ(fault("", "depth = 0.5\n"), "");
    EXPECT_EQ(fault(weightless, "rate = 0.5\nvelocity = [1, 0, 0]\n"), "");
    EXPECT_NE(fault("", "").find("give `depth` or `rate`"), std::string::npos);
    EXPECT_NE(fault("", "depth = 1\nrate = 2\n").find("not both"), std::string::npos);
    EXPECT_NE(fault(weightless, "depth = 1\n").find("without `gravity`"), std::string::npos);
}

// Still water that a sponge brings to a stream needs the speed of sound of the stream.
TEST(Waves, TheStreamOfASpongeIsAnExpectedSpeed)
{
    const Scene scene = parse_case(
        "dimensions = 2\ngravity = [0, 0, 0]\n[time]\nend = 1\n[particles]\nspacing = 0.05\n"
        "[fluid]\n[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [1, 0, 1]\n"
        "[[sponge]]\nmin = [0, 0, 0]\nmax = [1, 0, 1]\nrate = 1\nvelocity = [-3, 0, 4]\n",
        "case.toml");
    const Plan plan = make_plan(scene, fill(scene));
    EXPECT_DOUBLE_EQ(plan.expected_speed, 5);
    EXPECT_DOUBLE_EQ(plan.fluid->eos.c0, 50);
}

TEST(Waves, DampersWithoutWaterAreWarnedOf)
{
    const std::string still = "velocity = [0, 0, 0]\n";
    const auto sponge = [](double left, double top) {
        return fmt::format("[[sponge]]\nmin = [{}, 0, {}]\nmax = [{}, 0, {}]\ndepth = 0.66\n", left,
                           top - 1, left + 1, top);
    };
    EXPECT_EQ(warnings_of(read(still + sponge(3, 1))).find("sponge["), std::string::npos);
    for (const auto& [left, top] : {std::pair(5.0, 1.0), std::pair(3.0, 2.0)}) {
        EXPECT_NE(warnings_of(read(still + sponge(left, top))).find("no water in the sponge"),
                  std::string::npos)
            << left << " " << top;
    }
    const Scene dry = parse_case(
        "dimensions = 2\n[time]\nend = 1\n[particles]\nspacing = 0.05\n[[wall]]\nshape = \"box\"\n"
        "min = [-0.3, 0, 0]\nmax = [0, 0, 1]\n[wall.motion]\nabsorb = true\ndepth = 0.66\n"
        "[[body]]\nshape = \"box\"\nsize = [1, 1, 1]\ndensity = 500\nposition = [3, 0, 2]\n" +
            sponge(3, 1),
        "case.toml");
    const std::string told = warnings_of(dry);
    EXPECT_NE(told.find("sponge[0]: has no effect"), std::string::npos) << told;
    EXPECT_NE(told.find("absorb: has no effect"), std::string::npos) << told;
}

} // namespace
} // namespace hyoryu::test_waves
