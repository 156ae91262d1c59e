// SPDX-License-Identifier: MIT
// Fluid that leaves a wall: force and rate of density vanish together, so energy does not appear.
#include "runs.hpp"

#include <fmt/format.h>

namespace hyoryu::test_leaving_walls {
namespace {

// A patch of water beside a wall, without gravity, diffusion or viscosity: what is left is the pair
// of pressure and continuity.
std::string patch(double speed)
{
    return fmt::format(R"(
title = "patch"
dimensions = 2
gravity = [0.0, 0.0, 0.0]
[time]
end = 1.0
[particles]
spacing = 0.02
precision = "double"
[fluid]
sound_speed = 20.0
density_diffusion.model = "none"
viscosity.model = "none"
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.1, 0.0, 0.2]
velocity = [{}, 0.0, 0.0]
[[wall]]
name = "plate"
shape = "box"
min = [-0.2, 0.0, -0.4]
max = [0.0, 0.0, 0.6]
[domain]
min = [-0.4, 0.0, -0.4]
max = [1.0, 0.0, 0.6]
)",
                       speed);
}

double energy(const Simulation& sim)
{
    const Totals t = totals(sim);
    return t.fluid_kinetic + t.fluid_internal;
}

double nearest(const Simulation& sim)
{
    double x = infinity;
    for (const Vec3& at : sim.fluid->particles.fluid[field::position]) {
        x = std::min(x, at.x());
    }
    return x;
}

void turn_back(Simulation& sim)
{
    for (Vec3& v : sim.fluid->particles.fluid[field::velocity]) {
        v = -v;
    }
    update_rates(*sim.fluid);
}

TEST(LeavingWalls, WaterKeepsItsDensityAndItsEnergy)
{
    Simulation sim = make(patch(1.0));
    const double start = energy(sim);
    while (sim.clock.time < 0.2) { // three supports of the kernel away
        step_on(sim);
        // No pair of the fluid moves and solids do not pull: nothing but round-off changes.
        ASSERT_NEAR(energy(sim), start, 1e-12 * start) << "at " << sim.clock.time << " s";
    }
    EXPECT_LT(sim.conservation.worst_density_error, 1e-12);
}

TEST(LeavingWalls, WaterThatComesBackMeetsTheWallWhereItLeftIt)
{
    Simulation sim = make(patch(1.0));
    const double place = nearest(sim);
    while (sim.clock.time < 0.2) {
        step_on(sim);
    }
    turn_back(sim);
    const double start = energy(sim);
    while (nearest(sim) > place + 2e-3) { // 0.1 dp, some steps
        step_on(sim);
        // The gap is what the way out has opened, but for the round-off of some hundred steps.
        ASSERT_NEAR(energy(sim), start, 1e-12 * start) << "at " << nearest(sim) << " m";
    }
    EXPECT_LT(sim.conservation.worst_density_error, 1e-12);
}

// What the scheme gains in meeting a wall at Mach 0.05 over the energy of the start.
double gain(const std::string& cfl)
{
    Simulation sim = make(patch(-1.0), {"time.cfl=" + cfl});
    const double start = energy(sim);
    double most = start;
    while (sim.clock.time < 0.2) {
        step_on(sim);
        most = std::max(most, energy(sim));
    }
    EXPECT_GT(sim.conservation.worst_density_error, 0.01) << "it has met the wall";
    return most / start - 1;
}

// The patch touches the wall at time 0: in the first step, too, what compresses it slows it down.
TEST(LeavingWalls, WhatBouncesOffGainsNothing)
{
    EXPECT_LE(gain("0.6"), 1e-12);
    EXPECT_LE(gain("0.3"), 1e-12);
}

} // namespace
} // namespace hyoryu::test_leaving_walls
