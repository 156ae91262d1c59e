// SPDX-License-Identifier: MIT
// Friction, eddies, renormalised diffusion, corrected gradient, collisions, drive: same bits for
// any thread count and across a restart, momentum closes, and nothing of them where they are not
// asked for.
#include "runs.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

namespace hyoryu::test_rare_effects {
namespace {

// A driven channel that repeats itself, with a lid that slides along the period.
constexpr const char* channel = R"(
dimensions = 2
gravity = [0.0, 0.0, 0.0]
[time]
end = 10.0
[particles]
spacing = 0.05
[domain]
min = [0.0, 0.0, 0.0]
max = [0.8, 0.0, 1.0]
periodic = ["x"]
[fluid]
sound_speed = 10.0
gradient = "corrected"
wall_continuity = "paired"
kernel = "isotropic"
walls = "no_slip"
acceleration = [0.5, 0.0, 0.0]
[fluid.viscosity]
model = "sps"
kinematic = 0.02
smagorinsky = 1.0
[fluid.density_diffusion]
model = "antuono"
[fluid.collision]
model = "dynamic"
[fluid.cavitation]
model = "void"
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.8, 0.0, 1.0]
pressure_field = "1000"
[[wall]]
name = "bottom"
shape = "plane"
[[wall]]
name = "lid"
shape = "plane"
point = [0.0, 0.0, 1.0]
normal = [0.0, 0.0, -1.0]
[wall.motion]
velocity = [2.0, 0.0, 0.0]
)";

// A box falls into a basin, with friction.
constexpr const char* basin = R"(
[time]
end = 10.0
[particles]
spacing = 0.05
[fluid]
gradient = "corrected"
wall_continuity = "paired"
walls = "no_slip"
[fluid.viscosity]
model = "laminar"
kinematic = 0.01
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.6, 0.6, 0.4]
[[wall]]
name = "basin"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [1.2, 0.6, 1.0]
open = ["+z"]
[[body]]
name = "crate"
shape = "box"
size = [0.3, 0.3, 0.3]
density = 400.0
position = [0.4, 0.3, 0.6]
)";

TEST(RareEffects, SameBitsForAnyThreadCountAndAcrossARestart)
{
    for (const char* text : {channel, basin}) {
        set_threads(1);
        Simulation whole = make(text);
        advance(whole, 120);
        const Snapshot middle = save(whole);
        advance(whole, 90);

        set_threads(2);
        Simulation resumed = make_blank(text);
        restore(resumed, middle);
        advance(resumed, 90);
        expect_same_bits(save(whole), save(resumed));
        set_threads(0);
    }
}

// The lid goes round the period more than once.
TEST(RareEffects, MomentumCloses)
{
    Simulation sim = make(channel);
    while (sim.clock.time < 0.5) {
        advance(sim, 1);
    }
    EXPECT_LE(sim.conservation.worst_closure, 2e-7); // of sums in single precision
    EXPECT_EQ(sim.fluid->lost.count, 0);
    for (const Store* store : {&sim.fluid->particles.fluid, &sim.fluid->particles.wall}) {
        for (const Vec3& x : (*store)[field::position]) {
            ASSERT_LT(std::abs(x.x() - 0.4), 0.7); // particles of the lid stay about the period
        }
    }
    Simulation wet = make(basin);
    advance(wet, 200);
    EXPECT_LE(wet.conservation.worst_closure, 2e-7);
    EXPECT_GT(wet.loads.bodies[0].force.norm(), 0);
}

// What leaves the domain takes with it what acts on it; what acts on the others stays.
TEST(RareEffects, MomentumClosesWhereWaterLeaves)
{
    Simulation sim = make(R"(
dimensions = 2
gravity = [0.0, 0.0, 0.0]
[time]
end = 10.0
[particles]
spacing = 0.05
precision = "double"
[domain]
min = [0.0, 0.0, 0.0]
max = [1.0, 0.0, 1.0]
[fluid]
[fluid.viscosity]
model = "laminar"
kinematic = 0.1
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [1.0, 0.0, 1.0]
velocity_field = ["1 + z", "0", "x*z"]
)");
    while (sim.fluid->lost.count < 100) {
        advance(sim, 10);
    }
    EXPECT_LE(sim.conservation.worst_closure, 1e-13);
}

TEST(RareEffects, AreAbsentUnlessAskedFor)
{
    const std::array<const char*, 9> effects{"no_slip",
                                             "sps_turbulence",
                                             "drive",
                                             "particle_collision",
                                             "cavitation",
                                             "moving_walls",
                                             "corrected_gradient",
                                             "isotropic_kernel",
                                             "paired_walls"};
    const Simulation with = make(channel);
    for (const char* effect : effects) {
        EXPECT_TRUE(with.plan.runs(effect)) << effect;
    }
    const Simulation without = make(
        basin, {"fluid.walls=free_slip", "fluid.gradient=plain", "fluid.wall_continuity=plain"});
    for (const char* effect : effects) {
        EXPECT_FALSE(without.plan.runs(effect)) << effect;
    }
    const Particles& particles = without.fluid->particles;
    for (const Store* p : {&particles.fluid, &particles.wall, &particles.body}) {
        EXPECT_FALSE(p->has(field::velocity_sum) || p->has(field::depth) || p->has(field::strain) ||
                     p->has(field::turbulent_viscosity) || p->has(field::moments) ||
                     p->has(field::cavity) || p->has(field::gradient_correction) ||
                     p->has(field::paired_rate) || p->has(field::wall_compression));
    }
}

TEST(RareEffects, TheIsotropicKernelAsksForShorterSteps)
{
    for (const char* text : {channel, basin}) {
        const Simulation plain = make(text, {"fluid.kernel=wendland"});
        const Simulation even = make(text, {"fluid.kernel=isotropic"});
        ASSERT_EQ(plain.plan.limits.size(), even.plan.limits.size());
        for (std::size_t k = 0; k < plain.plan.limits.size(); ++k) {
            const TimeLimit& limit = plain.plan.limits[k];
            const bool sound = limit.name == "acoustic" || limit.name == "light body";
            const double shorter = sound ? 1.065 : (limit.name == "viscous" ? 1.14 : 1);
            EXPECT_DOUBLE_EQ(limit.dt, shorter * even.plan.limits[k].dt) << limit.name;
        }
    }
}

// Water that a light body approaches is compressed twice as fast.
TEST(RareEffects, ThePairedContinuityAsksForShorterStepsOfLightBodies)
{
    const Simulation plain = make(basin, {"fluid.wall_continuity=plain"});
    const Simulation paired = make(basin, {"fluid.wall_continuity=paired"});
    ASSERT_EQ(plain.plan.limits.size(), paired.plan.limits.size());
    for (std::size_t k = 0; k < plain.plan.limits.size(); ++k) {
        const TimeLimit& limit = plain.plan.limits[k];
        const double shorter = limit.name == "light body" ? std::numbers::sqrt2 : 1;
        EXPECT_NEAR(limit.dt, shorter * paired.plan.limits[k].dt, 1e-12 * limit.dt) << limit.name;
    }
}

TEST(RareEffects, EddiesOfNoLengthGiveTheBitsOfLaminarFlow)
{
    Simulation laminar = make(basin);
    Simulation eddies = make(basin, {"fluid.viscosity.model=sps", "fluid.viscosity.smagorinsky=0"});
    advance(laminar, 60);
    advance(eddies, 60);
    expect_same_bits(save(laminar), save(eddies));
}

} // namespace
} // namespace hyoryu::test_rare_effects
