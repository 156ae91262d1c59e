// SPDX-License-Identifier: MIT
// What a step costs, and what of it each effect takes.
#include "hyoryu/sim/cost.hpp"

#include "runs.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hyoryu {
namespace {

constexpr const char* tank = R"(
dimensions = 2
[time]
end = 0.01
[particles]
spacing = 0.02
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.2, 0.0, 0.2]
[[wall]]
name = "basin"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [0.2, 0.0, 0.4]
open = ["+z"]
)";

// Effects whose share is measured in the tank with these changes.
std::vector<std::string> measured(const std::vector<std::string>& overrides)
{
    Simulation sim = make(tank, overrides);
    const StepCost cost = measure_cost(sim, 10);
    std::vector<std::string> list;
    for (const StepCost::Share& share : cost.effects) {
        list.push_back(share.effect);
    }
    return list;
}

TEST(Cost, NamesTheEffectsThatRunAndNoOther)
{
    const std::vector<std::string> usual{"artificial_viscosity", "density_diffusion"};
    EXPECT_EQ(measured({}), usual);
    const std::vector<std::string> rich{"laminar_viscosity", "density_diffusion", "no_slip",
                                        "particle_collision"};
    EXPECT_EQ(measured({"fluid.viscosity.model=laminar", "fluid.viscosity.kinematic=1e-3",
                        "fluid.walls=no_slip", "fluid.collision.model=dynamic"}),
              rich);
    EXPECT_TRUE(
        measured({"fluid.viscosity.model=none", "fluid.density_diffusion.model=none"}).empty());
}

// The steps that are timed lie beyond the end, where nothing may shorten them to nothing.
TEST(Cost, IsMeasuredAtTheEndOfARunToo)
{
    Simulation sim = make(tank);
    while (!finished(sim.clock, sim.scene)) {
        step_on(sim);
    }
    const double end = sim.clock.time;
    const double dt = time_limit(sim).dt;
    const StepCost cost = measure_cost(sim, 10);
    EXPECT_GT(sim.clock.time, end + 5 * dt) << "ten whole steps, and the one before them";
    EXPECT_GT(cost.seconds, 0);
    for (const StepCost::Share& share : cost.effects) {
        EXPECT_LT(share.share, 1) << share.effect;
    }
}

// Water at rest does not develop: as many steps as planned, as long as the first. The factor is
// wide for a machine with other work; what a column that collapses adds is told by the shipped
// cases.
TEST(Cost, OfWaterAtRestDoesNotChange)
{
    Simulation sim = make(tank, {"time.end=0.2"});
    const auto found = measure_development(sim, 50, [] { return true; });
    ASSERT_TRUE(found.has_value());
    EXPECT_TRUE(finished(sim.clock, sim.scene));
    EXPECT_NEAR(found->steps * sim.plan.expected_steps, static_cast<double>(sim.clock.step), 1e-6);
    EXPECT_NEAR(found->steps, 1, 0.02);
    EXPECT_GT(found->step, 0.2);
    EXPECT_LT(found->step, 5);
}

TEST(Cost, OfTheRunCountsBodiesApart)
{
    StepCost cost{.seconds = 5, .bodies = 2};
    EXPECT_EQ(seconds_of_run(cost), 5);
    cost.development = Development{.step = 3};
    EXPECT_EQ(seconds_of_run(cost), 3 * 3 + 2);
}

TEST(Cost, DevelopmentIsLeftWhereItTakesTooLongOrGoesWrong)
{
    Simulation sim = make(tank);
    EXPECT_FALSE(measure_development(sim, 5, [n = 0]() mutable { return ++n < 3; }).has_value());
    EXPECT_EQ(sim.clock.step, 3);
    Simulation wrong = make(tank);
    wrong.fluid->particles[field::velocity][0].x() = std::numeric_limits<real>::quiet_NaN();
    EXPECT_FALSE(measure_development(wrong, 5, [] { return true; }).has_value());
    Simulation short_run = make(tank);
    EXPECT_FALSE(measure_development(short_run, 1'000'000, [] { return true; }).has_value());
}

} // namespace
} // namespace hyoryu
