// SPDX-License-Identifier: MIT
// Walls that follow a path: their particles, restart, and what they do to the water.
#include "runs.hpp"

#include <gtest/gtest.h>

#include <map>

namespace hyoryu::test_moving_walls {
namespace {

// A paddle at the left end of a channel, in the plane.
constexpr const char* flume = R"(
dimensions = 2
[time]
end = 2.0
[particles]
spacing = 0.02
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.6, 0.0, 0.2]
[[wall]]
name = "basin"
shape = "basin"
min = [-0.5, 0.0, 0.0]
max = [0.6, 0.0, 0.5]
open = ["+z"]
[[wall]]
name = "paddle"
shape = "box"
min = [-0.1, 0.0, 0.0]
max = [0.0, 0.0, 0.4]
[wall.motion]
times = [0.0, 0.01, 0.03, 0.08]
places = [[0, 0, 0], [0.002, 0, 0], [0.008, 0, 0], [0.01, 0, 0]]
)";

TEST(Paddle, ParticlesStandOnThePathAtEveryStep)
{
    Simulation sim = make(flume);
    const std::vector<Vec3> start = sim.wall_start;
    ASSERT_FALSE(start.empty());
    const Filling filling = fill(sim.scene);
    std::map<std::int64_t, Vec3> basin; // by number
    for (std::size_t k = 0; k < filling.wall.size(); ++k) {
        basin[static_cast<std::int64_t>(filling.fluid.size() + k)] = filling.wall[k];
    }
    Vec3 pushed = Vec3::Zero();
    for (int k = 0; k < 40; ++k) {
        step_on(sim);
        const Store& walls = sim.fluid->particles.wall;
        const Motion& motion = sim.scene.walls[1].motion;
        ASSERT_LT(start.size(), walls.owner().size());
        for (std::size_t row = 0; row < walls.owner().size(); ++row) {
            const bool paddle = walls.owner()[row] == -2;
            ASSERT_EQ(paddle, row < start.size());
            const Vec3 from = paddle ? start[row] : basin.at(walls.id()[row]);
            const Vec3 moved = walls[field::position][row] - from;
            // the place is the sum of the start and the displacement, in one rounding
            EXPECT_LE(
                (moved - (paddle ? displacement(motion, sim.clock.time) : Vec3::Zero())).norm(),
                1e-15);
            EXPECT_EQ(walls[field::velocity][row],
                      paddle ? velocity(motion, sim.clock.time) : Vec3::Zero());
        }
        pushed = totals(sim).momentum;
    }
    EXPECT_GT(sim.clock.time, 0.01);
    EXPECT_GT(pushed.x(), 0); // the water is pushed forward
}

TEST(Paddle, RestartContinuesWithTheSameBits)
{
    Simulation whole = make(flume);
    for (int k = 0; k < 40; ++k) {
        step_on(whole);
    }
    Simulation second = make_blank(flume);
    restore(second, save(whole));
    for (int k = 0; k < 15; ++k) {
        step_on(whole);
        step_on(second);
    }
    const Snapshot a = save(whole);
    const Snapshot b = save(second);
    for (const auto& [name, array] : a.arrays) {
        EXPECT_TRUE(array.values == b.arrays.at(name).values) << name;
    }
}

} // namespace
} // namespace hyoryu::test_moving_walls
