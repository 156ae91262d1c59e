// SPDX-License-Identifier: MIT
// What a step costs, and what of it each effect takes.
#include "hyoryu/sim/cost.hpp"

#include "dice.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

namespace hyoryu::test_cost {
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
    const std::vector<std::string> rich{"laminar_viscosity", "density_diffusion",
                                        "particle_collision", "no_slip"};
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
    const double dt = time_limit(sim, survey(sim)).dt;
    const StepCost cost = measure_cost(sim, 10);
    EXPECT_GT(sim.clock.time, end + 5 * dt) << "ten whole steps, and the one before them";
    EXPECT_GT(cost.seconds, 0);
    for (const StepCost::Share& share : cost.effects) {
        EXPECT_LT(share.share, 1) << share.effect;
    }
}

// Noise of rounds: the share that is told is never below zero and never without its spread, and the
// two together hold the median of the rounds.
TEST(Cost, D6SharesAreNeverBelowZeroNorWithoutTheirSpread)
{
    const StepCost::Share few = share_of("shifting", {0.3, 0.1, 0.2});
    EXPECT_DOUBLE_EQ(few.share, 0.2);
    EXPECT_DOUBLE_EQ(few.spread, 0.1);
    const StepCost::Share many = share_of("shifting", {0.1, 0.2, 0.3, 0.4, 9.0});
    EXPECT_DOUBLE_EQ(many.share, 0.3);
    EXPECT_DOUBLE_EQ(many.spread, 0.1); // of 0.2 to 0.4: one disturbed round counts for nothing
    const StepCost::Share below = share_of("viscosity", {-0.021, -0.023, -0.025, -0.022, -0.024});
    EXPECT_EQ(below.share, 0);
    EXPECT_DOUBLE_EQ(below.spread, 0.023);
    Dice dice(6);
    for (int scene = 0; scene < 500; ++scene) {
        std::vector<double> rounds(1 + static_cast<std::size_t>(dice.below(12)));
        const double middle = dice.between(-0.1, 0.2);
        for (double& round : rounds) {
            round = middle + dice.between(-0.1, 0.1);
        }
        const StepCost::Share told = share_of("effect", rounds);
        std::ranges::nth_element(rounds,
                                 rounds.begin() + static_cast<std::ptrdiff_t>(rounds.size() / 2));
        EXPECT_GE(told.share, 0);
        EXPECT_GE(told.spread, 0);
        if (rounds.size() % 2 == 1) {
            const double median = rounds[rounds.size() / 2];
            EXPECT_GE(median, told.share - told.spread - 1e-15);
            EXPECT_LE(median, told.share + told.spread + 1e-15);
        }
    }
}

TEST(Cost, D6MeasuredSharesAreNeverBelowZero)
{
    for (int k = 0; k < 3; ++k) {
        Simulation sim = make(tank);
        for (const StepCost::Share& share : measure_cost(sim, 20).effects) {
            EXPECT_GE(share.share, 0) << share.effect;
            EXPECT_GT(share.spread, 0) << share.effect;
        }
    }
}

// Water at rest does not develop: as many steps as planned, as long as the first. The factor is
// wide for a machine with other work, and of three looks the middle one counts; what a column that
// collapses adds is told by the shipped cases.
TEST(Cost, OfWaterAtRestDoesNotChange)
{
    std::array<double, 3> step{};
    for (double& once : step) {
        Simulation sim = make(tank, {"time.end=0.2"});
        Simulation again = make(tank, {"time.end=0.2"});
        const auto found = measure_development(sim, again, 50, [] { return true; });
        ASSERT_TRUE(found.has_value());
        EXPECT_TRUE(finished(sim.clock, sim.scene));
        EXPECT_NEAR(found->steps * sim.plan.expected_steps, static_cast<double>(sim.clock.step),
                    1e-6);
        EXPECT_NEAR(found->steps, 1, 0.02);
        EXPECT_NEAR(found->builds * static_cast<double>(sim.clock.step),
                    static_cast<double>(sim.fluid->neighbours.builds), 1e-9);
        once = found->step;
    }
    std::ranges::sort(step);
    EXPECT_GT(step[1], 0.2);
    EXPECT_LT(step[1], 5);
}

TEST(Cost, OfListsIsThatOfMakingThemOnceAndAPartOfAStep)
{
    Simulation sim = make(tank);
    const StepCost cost = measure_cost(sim, 10);
    EXPECT_GT(cost.build, 0);
    EXPECT_GE(cost.lists, 0);
    EXPECT_LT(cost.lists, cost.seconds);
}

TEST(Cost, OfTheRunCountsBodiesAndListsApart)
{
    StepCost cost{.seconds = 6, .bodies = 2, .lists = 1, .build = 20};
    EXPECT_EQ(seconds_of_run(cost), 6);
    cost.development = Development{.step = 3, .builds = 0.25};
    EXPECT_EQ(seconds_of_run(cost), 3 * 3 + 2 + 5);
}

TEST(Cost, DevelopmentIsLeftWhereItTakesTooLongOrGoesWrong)
{
    Simulation again = make(tank);
    Simulation sim = make(tank);
    EXPECT_FALSE(
        measure_development(sim, again, 5, [n = 0]() mutable { return ++n < 3; }).has_value());
    EXPECT_EQ(sim.clock.step, 3);
    Simulation wrong = make(tank);
    wrong.fluid->particles.fluid[field::velocity][0].x() = std::numeric_limits<real>::quiet_NaN();
    EXPECT_FALSE(measure_development(wrong, again, 5, [] { return true; }).has_value());
    Simulation short_run = make(tank);
    EXPECT_FALSE(measure_development(short_run, again, 1'000'000, [] { return true; }).has_value());
}

constexpr const char* bounce = R"(
[time]
end = 1.0
step = 1e-3
[particles]
spacing = 0.05
[[wall]]
shape = "plane"
[[body]]
shape = "box"
size = [0.2, 0.2, 0.2]
density = 500
position = [0, 0, 0.3]
[contact]
restitution = 0.5
)";

TEST(Cost, OfBodiesIsThatOfTheirRunAndItsImpacts)
{
    Simulation counted = make(bounce);
    double impacts = 0;
    while (!finished(counted.clock, counted.scene)) {
        step_on(counted);
        for (const Contact& contact : counted.contacts) {
            impacts += contact.kind == Contact::Kind::impact ? 1 : 0;
        }
    }
    ASSERT_GT(impacts, 0);
    Simulation sim = make(bounce);
    const auto cost = measure_bodies(sim, [] { return true; });
    ASSERT_TRUE(cost.has_value());
    EXPECT_TRUE(finished(sim.clock, sim.scene));
    EXPECT_EQ(cost->impacts, impacts);
    EXPECT_GT(cost->seconds, 0);
    EXPECT_EQ(cost->seconds, cost->bodies);
}

TEST(Cost, OfBodiesIsNotToldByNoStep)
{
    Simulation sim = make(bounce);
    EXPECT_FALSE(measure_bodies(sim, [] { return false; }).has_value());
}

// Forty boxes in flight, then on the floor: a look that ends soon after they land sees steps that
// grow, and the cost of those to come is not theirs. The clock of the test counts contacts, so that
// no other work of the machine decides; it tells the cost of as long a look at bodies in flight.
TEST(Cost, OfBodiesIsNotToldByStepsThatGrow)
{
    const auto look = [](int steps) {
        Simulation sim =
            make(bounce, {"body[0].copies.count=[5,8,1]", "body[0].copies.pitch=[0.3,0.3,0]"});
        double seconds = 0;
        return measure_bodies(
            sim, [&] { return sim.clock.step < steps; },
            [&] { return seconds += 1 + static_cast<double>(sim.contacts.size()); });
    };
    EXPECT_FALSE(look(300).has_value());
    const auto in_flight = look(150);
    ASSERT_TRUE(in_flight.has_value());
    EXPECT_EQ(in_flight->seconds, 1); // of the clock, for no contact
}

// Water in the air falls out of the domain.
TEST(Cost, DevelopmentTellsWhatFluidIsLeft)
{
    Simulation rests = make(tank, {"time.end=0.05"});
    Simulation again = make(tank);
    const auto all = measure_development(rests, again, 5, [] { return true; });
    ASSERT_TRUE(all.has_value());
    EXPECT_NEAR(all->fluid, 1, 1e-9);
    EXPECT_EQ(all->fluid_end, 1);
    Simulation falls =
        make(tank, {"time.end=0.25", "wall[0].min=[0.0,0.0,-9.0]", "wall[0].max=[0.2,0.0,-8.0]",
                    "domain.min=[-0.1,0.0,0.0]", "domain.max=[0.3,0.0,0.4]"});
    const auto some = measure_development(falls, again, 5, [] { return true; });
    ASSERT_TRUE(some.has_value());
    EXPECT_LT(some->fluid_end, 0.2);
    EXPECT_GT(some->fluid, 0.3);
    EXPECT_LT(some->fluid, 0.9);
}

// Stalls of up to a thousand steps in a step of ten, in steps that grow to three times their first:
// the mean of them without stalls is that of what was added up without them.
TEST(Cost, StallsAreLeftOutOfStepsThatGrow)
{
    Dice dice(23);
    for (int n = 0; n < 50; ++n) {
        const int count = 30 + dice.below(1000);
        const double grows = dice.between(0, 2);
        std::vector<double> seconds;
        double plain = 0;
        for (int k = 0; k < count; ++k) {
            const double own = 1e-3 * (1 + grows * k / count) * dice.between(0.9, 1.1);
            plain += own / count;
            seconds.push_back(own + (dice.chance(0.1) ? dice.between(0, 1) : 0));
        }
        EXPECT_NEAR(mean_without_stalls(seconds) / plain, 1, 0.05)
            << count << " steps that grow by " << grows;
    }
    EXPECT_EQ(mean_without_stalls(std::vector<double>{}), 0);
    EXPECT_EQ(mean_without_stalls(std::vector<double>{2, 4}), 3);
}

// Columns of water of any width and depth that break in a tank: the steps that the coarse run of
// twice the spacing foretells are those of the run, within the quarter that the forecast promises.
TEST(Cost, StepsForetoldAreStepsTaken)
{
    Dice dice(17);
    for (int n = 0; n < 4; ++n) {
        const double width = 0.04 * (2 + dice.below(4));
        const double depth = 0.04 * (2 + dice.below(4));
        const std::vector<std::string> overrides{
            "time.end=0.3", "particles.spacing=0.01",
            fmt::format("fluid.block[0].max=[{},0.0,{}]", width, depth),
            "wall[0].max=[0.6,0.0,0.4]"};
        std::vector<std::string> coarser = overrides;
        coarser[1] = "particles.spacing=0.02";
        Simulation coarse = make(tank, coarser);
        Simulation again = make(tank, coarser);
        const auto found = measure_development(coarse, again, 5, [] { return true; });
        ASSERT_TRUE(found.has_value());
        Simulation run = make(tank, overrides);
        const double foretold = found->steps * run.plan.expected_steps;
        while (!finished(run.clock, run.scene)) {
            step_on(run);
        }
        EXPECT_NEAR(foretold / static_cast<double>(run.clock.step), 1, 0.25)
            << width << " m x " << depth << " m";
    }
}

TEST(Cost, OfTheRunHasWhatIsWritten)
{
    EXPECT_EQ(seconds_of_run({.seconds = 5, .bodies = 2, .output = 1}), 6);
    EXPECT_EQ(seconds_of_run({.seconds = 5, .output = 1, .slowdown = 2}), 11);
}

TEST(Cost, OfARowIsAFewLooksAtAllParticles)
{
    const double row = measure_row(make(tank));
    EXPECT_GT(row, 0);
    EXPECT_LT(row, 0.1);
}

} // namespace
} // namespace hyoryu::test_cost
