// SPDX-License-Identifier: MIT
// What a particle costs in memory, counted as capacity.
#include "bench/dam_break.hpp"

#include "hyoryu/fluid/memory.hpp"
#include "hyoryu/scene/case_file.hpp"

#include <gtest/gtest.h>

namespace hyoryu::bench {
namespace {

constexpr double most = 450; // [B] a particle, at h/dp = 1.5

double bytes_a_particle(const Simulation& sim)
{
    return static_cast<double>(total(memory_of(*sim.fluid))) /
           static_cast<double>(sim.plan.counts.particles());
}

TEST(Memory, OfADamBreakInSpaceWithAllOn)
{
    // 57,000 fluid particles in flow: large enough that pages of lists, a megabyte each, are
    // filled.
    Simulation sim = make_dam_break(0.0112);
    develop(sim, 0.1, {});
    ASSERT_GT(sim.fluid->neighbours.builds, 2);
    EXPECT_LT(bytes_a_particle(sim), most);
    // The parts that cannot be missing: columns of 152 bytes and records of 32.
    EXPECT_GT(bytes_a_particle(sim), 152 + 32);
}

// Every particle has a full support, and vortices ask for lists with a wide skin.
TEST(Memory, OfFluidWithoutWalls)
{
    constexpr const char* vortices = R"toml(
title = "Vortices"
gravity = [0.0, 0.0, 0.0]
[time]
end = 100.0
[particles]
spacing = 0.025
[domain]
min = [0.0, 0.0, 0.0]
max = [1.0, 1.0, 1.0]
periodic = ["x", "y", "z"]
[fluid]
sound_speed = 34.3
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [1.0, 1.0, 1.0]
velocity_field = ["2*sin(2*_pi*x)*cos(2*_pi*y)", "-2*cos(2*_pi*x)*sin(2*_pi*y)", "0"]
[output]
every = 100.0
)toml";
    const Scene scene = parse_case(vortices, "vortices");
    const Filling filling = fill(scene);
    Simulation sim = make_simulation(scene, make_plan(scene, filling), filling);
    while (sim.fluid->neighbours.builds < 4) {
        step(sim);
    }
    EXPECT_GT(sim.fluid->neighbours.skins.fluid, 0.3 * scene.spacing);
    EXPECT_LT(bytes_a_particle(sim), most);
}

} // namespace
} // namespace hyoryu::bench
