// SPDX-License-Identifier: MIT
// Sponges: fluid comes to their velocity at their rate, and the books of momentum count them.
#include "runs.hpp"

#include "hyoryu/sim/watch.hpp"

#include "dice.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace hyoryu::test_sponges {
namespace {

struct Stream {
    double length, spacing, rate;
    Vec3 before, asked; // velocities [m/s]
    bool to_the_left, parabolic;

    // x at which damping begins and where it is strongest.
    double begin() const { return to_the_left ? length : 0; }
    double side() const { return length - begin(); }

    std::string text() const
    {
        return fmt::format(R"(
dimensions = 2
gravity = [0, 0, 0]
[time]
end = 100.0
[particles]
spacing = {1}
precision = "double"
[domain]
min = [0, 0, 0]
max = [{0}, 0, {0}]
periodic = ["x", "z"]
[fluid]
sound_speed = 20.0
[[fluid.block]]
shape = "box"
min = [0, 0, 0]
max = [{0}, 0, {0}]
velocity = [{2}, 0, {3}]
[[sponge]]
min = [0, 0, 0]
max = [{0}, 0, {0}]
side = "{4}"
rate = {5}
velocity = [{6}, 0, {7}]
profile = "{8}"
)",
                           length, spacing, before.x(), before.z(), to_the_left ? "-x" : "+x", rate,
                           asked.x(), asked.z(), parabolic ? "parabolic" : "uniform");
    }
};

Stream thrown(Dice& dice)
{
    Stream s;
    s.length = dice.between(0.5, 3);
    s.spacing = s.length / std::floor(dice.between(12, 24)); // a period is whole spacings
    s.rate = std::exp(dice.between(0, 5));
    s.before = {dice.between(-1, 1), 0, dice.between(-1, 1)};
    s.asked = {dice.between(-1, 1), 0, dice.between(-1, 1)};
    s.to_the_left = dice.chance(0.5);
    s.parabolic = dice.chance(0.5);
    return s;
}

// A stream without pressure feels no other force: after one step v = u + (v0 - u) exp(-r s^2 dt).
// The fluid drifts by less than v0 dt before it is damped, which changes s^2 by 2 v0 dt / length
// and a parabola by 6.
TEST(Sponges, DampAtTheirRateTowardsTheirVelocity)
{
    Dice dice(31);
    for (int n = 0; n < 10; ++n) {
        const Stream s = thrown(dice);
        Simulation sim = make(s.text());
        const auto at = sim.fluid->particles.fluid[field::position];
        const std::vector<Vec3> x(at.begin(), at.end());
        step_on(sim);
        const auto v = sim.fluid->particles.fluid[field::velocity];
        const double change = s.before.norm() + 1.5 * s.asked.norm();
        const double drift = s.before.norm() * sim.clock.time / s.length;
        const double tolerance = 1e-12 + (2 + 6) * drift * s.rate * sim.clock.time * change;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double depth = (x[i].x() - s.begin()) / (s.side() - s.begin());
            const double kept = std::exp(-s.rate * depth * depth * sim.clock.time);
            const double height = x[i].z() / s.length;
            const Vec3 asked = (s.parabolic ? 6 * height * (1 - height) : 1.0) * s.asked;
            const Vec3 exact = asked + kept * (s.before - asked);
            EXPECT_NEAR((v[static_cast<Index>(i)] - exact).norm(), 0, tolerance);
        }
    }
}

TEST(Sponges, RestoreAStreamAndCloseTheBooks)
{
    Dice dice(32);
    for (int n = 0; n < 4; ++n) {
        Stream s = thrown(dice);
        s.rate = 20;
        s.before = s.before / 4; // the stream has more energy than the start
        s.parabolic = false;
        s.asked.x() = dice.between(0.5, 1);
        Simulation sim = make(s.text());
        const double mass =
            sim.fluid->parameters.mass * static_cast<double>(sim.fluid->particles.fluid.size());
        while (sim.clock.time < 3 * s.length / s.asked.x()) { // three times through the sponge
            step_on(sim);
        }
        const auto v = sim.fluid->particles.fluid[field::velocity];
        Vec3 mean{0, 0, 0};
        for (const Vec3& one : v) {
            mean += one / static_cast<double>(v.size());
        }
        EXPECT_NEAR((mean - s.asked).norm(), 0, 0.02); // of speeds of about 1 m/s
        // What the sponges gave is what the fluid has gained.
        EXPECT_NEAR((sim.conservation.wall_impulse - mass * (mean - s.before)).norm(), 0,
                    1e-9 * mass);
        EXPECT_LT(sim.conservation.worst_closure, 1e-10); // rounding, in double precision
        EXPECT_NO_THROW(watch_energy(sim, totals(sim)));  // the sponge drives it: no false alarm
    }
}

// Water at rest on a periodic lattice: nothing but the sponge changes its density in the first
// step, rho = rho_a + (rho_0 - rho_a) exp(-c0/L s^2 dt), but for what the difference in density
// makes of itself in the rest of the step (1e-5 of the change).
TEST(Sponges, RelaxThePressureWithinAPassageOfSound)
{
    Dice dice(33);
    for (int n = 0; n < 10; ++n) {
        Stream s = thrown(dice);
        s.before = s.asked = {0, 0, 0};
        const double before = dice.between(1000, 5000);
        const double asked = dice.between(-1000, 9000);
        std::string text = s.text() + fmt::format("pressure = {}\n", asked);
        const std::string still = "velocity = [0, 0, 0]";
        text.replace(text.find(still), still.size(),
                     fmt::format("pressure_field = \"{}\"", before));
        Simulation sim = make(text);
        const EquationOfState& eos = sim.fluid->parameters.eos;
        const auto x = sim.fluid->particles.fluid[field::position];
        const auto rho = sim.fluid->particles.fluid[field::density];
        const std::vector<Vec3> place(x.begin(), x.end());
        const std::vector<real> start(rho.begin(), rho.end());
        step_on(sim);
        const double dt = sim.clock.time;
        for (std::size_t i = 0; i < place.size(); ++i) {
            const double depth = (place[i].x() - s.begin()) / (s.side() - s.begin());
            const double kept = std::exp(-eos.c0 / s.length * depth * depth * dt);
            const double own = eos.density(asked);
            const double exact = own + kept * (start[i] - own);
            EXPECT_NEAR(rho[static_cast<Index>(i)], exact, 1e-5 * std::abs(own - start[i]));
        }
    }
}

// The pressure is hydrostatic above the lower side: water in a tank with that of its depth there
// stays as it is, with another it rises or falls.
TEST(Sponges, LeaveWaterWithTheRightPressureAtRest)
{
    Dice dice(35);
    for (int n = 0; n < 3; ++n) {
        const double depth = dice.between(0.3, 2);
        const auto mean_height_after = [&](double share) {
            Simulation sim =
                make(fmt::format(R"(
dimensions = 2
[time]
end = 100.0
[particles]
spacing = {1}
[[fluid.block]]
shape = "box"
min = [0, 0, 0]
max = [{0}, 0, {0}]
[[wall]]
name = "tank"
shape = "basin"
min = [0, 0, 0]
max = [{0}, 0, {2}]
open = ["+z"]
[[sponge]]
min = [0, 0, 0]
max = [{0}, 0, {2}]
rate = 10
pressure = {3}
)",
                                 depth, depth / 16, 2 * depth, share * 1000 * 9.81 * depth));
            const double start = totals(sim).fluid_potential;
            while (sim.clock.time < 2 * std::sqrt(depth / 9.81)) {
                step_on(sim);
            }
            return totals(sim).fluid_potential / start;
        };
        EXPECT_NEAR(mean_height_after(1), 1, 0.005);
        EXPECT_GT(mean_height_after(1.3), 1.01);
        EXPECT_LT(mean_height_after(0.7), 0.99);
    }
}

// A closed box whose pressure is wrong by more than it will be: within a few passages it has that
// of the sponge, the momentum is counted, and energy that the sponge gives is no alarm.
TEST(Sponges, HoldThePressureOfAClosedBox)
{
    Dice dice(34);
    for (int n = 0; n < 3; ++n) {
        Stream s = thrown(dice);
        s.before = s.asked = {0, 0, 0};
        s.rate = 10;
        const double asked = dice.between(2000, 8000);
        Simulation sim = make(s.text() + fmt::format("pressure = {}\n", asked));
        while (sim.clock.time < 30 * s.length / 20) {
            step_on(sim);
        }
        const auto p = sim.fluid->particles.fluid[field::pressure];
        const double mean =
            std::accumulate(p.begin(), p.end(), 0.0) / static_cast<double>(p.size());
        EXPECT_NEAR(mean, asked, 0.02 * asked);
        EXPECT_LT(sim.conservation.worst_closure, 1e-10);
        EXPECT_NO_THROW(watch_energy(sim, totals(sim)));
    }
}

} // namespace
} // namespace hyoryu::test_sponges
