// SPDX-License-Identifier: MIT
// A pulse of the pressure beside a standing body: shorter than sound needs to pass below the body,
// it acts on a part of its joint.
#include "dice.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace hyoryu::test_joint_pulse {
namespace {

// A fixed box on the floor of a tank, in water of a height.
std::string box_in_tank(double spacing, double width, double depth)
{
    const double left = 15 * spacing;
    const double across = 2 * left + width;
    return fmt::format(
        "dimensions = 2\n[time]\nend = 9\n[particles]\nspacing = {}\n[fluid]\n"
        "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [{}, 0, {}]\n"
        "[[wall]]\nshape = \"basin\"\nmin = [0, 0, 0]\nmax = [{}, 0, {}]\nopen = [\"+z\"]\n"
        "[[body]]\nshape = \"box\"\nsize = [{}, 0, {}]\ndensity = 5000\n"
        "position = [{}, 0, {}]\nlocks = [\"x\", \"z\", \"ry\"]\n",
        spacing, across, depth, across, 3 * depth, width, 2 * depth, left + width / 2, depth);
}

double mean_pressure(const Simulation& sim)
{
    double sum = 0;
    for (const JointLoad& load : sim.seepage.loads[0]) {
        sum += load.pressure;
    }
    return sum / static_cast<double>(sim.seepage.loads[0].size());
}

void compress(Simulation& sim, double pressure)
{
    const double c0 = sim.fluid->parameters.eos.c0;
    for (real& density : sim.fluid->particles.fluid[field::density]) {
        density += static_cast<real>(pressure / (c0 * c0));
    }
}

// All water of the tank is compressed for one step. The box is open at both sides: sound passes
// half of its width. The exponential is that of the model (`JointInflow` holds it against a front);
// what is tested is that the pressure of the joint follows it, with the width, the open rims and
// the step of this scene. One part in five for the change of the pressures within the step.
TEST(JointPulse, ActsOnThePartThatSoundReaches)
{
    Dice dice(12);
    for (int n = 0; n < 8; ++n) {
        const double spacing = n % 2 == 0 ? 0.05 : 0.02;
        const double width = spacing * dice.between(8, 24);
        const double depth = spacing * dice.between(6, 12);
        Simulation sim = make(box_in_tank(spacing, width, depth));
        while (sim.clock.time < 0.05) {
            step_on(sim);
        }
        const double before = mean_pressure(sim);
        const double pulse = dice.between(10, 60) * 9810 * depth;
        compress(sim, pulse);
        step_on(sim);
        const double risen = mean_pressure(sim) - before;
        const double reached =
            sim.fluid->parameters.eos.c0 * sim.clock.dt / (width / 2); // of the half width
        const double part = 1 - std::exp(-2 * reached);
        EXPECT_NEAR(risen / pulse, part, 0.2 * part) << width / spacing;
        compress(sim, -pulse);
        step_on(sim);
        EXPECT_LT(mean_pressure(sim), before + 0.1 * pulse) << "the pulse is over";
    }
}

} // namespace
} // namespace hyoryu::test_joint_pulse
