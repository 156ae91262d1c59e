// SPDX-License-Identifier: MIT
// What memory and disk are foretold to be. That they come out so is for the tests of the program.
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/disk.hpp"
#include "hyoryu/scene/memory.hpp"

#include <gtest/gtest.h>

namespace hyoryu::test_forecast {
namespace {

const std::string fall = R"(
[time]
end = 1.0
step = 1e-3
[particles]
spacing = 0.02
[[wall]]
shape = "plane"
[[body]]
shape = "box"
size = [0.2, 0.2, 0.2]
density = 500
position = [0, 0, 1]
[output]
every = 1.0
)";

const std::string tank = R"(
[time]
end = 0.1
[particles]
spacing = 0.02
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.6, 0.6, 0.4]
[[wall]]
name = "basin"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [0.6, 0.6, 0.8]
open = ["+z"]
[output]
every = 0.01
history_every = 0.01
)";

struct Planned {
    Scene scene;
    Plan plan;
};

Planned planned(const std::string& text, const std::vector<std::string>& overrides = {})
{
    Planned p{parse_case(text, "case.toml", overrides), {}};
    p.plan = make_plan(p.scene, fill(p.scene));
    return p;
}

double disk(const Planned& p, Course course)
{
    course.steps = p.plan.expected_steps;
    return disk_bytes(p.scene, p.plan, course);
}

double disk(const Planned& p)
{
    return disk(p, Course{});
}

double memory(const Planned& p, double impacts)
{
    return memory_bytes(p.scene, p.plan, {.steps = p.plan.expected_steps, .impacts = impacts});
}

// A heap of 1,960 boxes wrote 344 bytes for each of 1.2 million rows, of them 97 in results.h5.
TEST(Forecast, CountsImpactsOnDiskAndAtTheEndInMemory)
{
    const Planned p = planned(fall);
    constexpr double rows = 1e6;
    EXPECT_NEAR((disk(p, {.impacts = rows}) - disk(p)) / rows, 344, 35);
    const double held = (memory(p, rows) - memory(p, 0)) / rows;
    EXPECT_GT(held, 344) << "the table as text and as numbers, beside its image";
    EXPECT_LT(held, 3 * 344);
}

// Without weight and with nothing to meet, a body that turns stays where it is.
TEST(Forecast, GivesNumbersThatNeverChangeNoRoom)
{
    const Planned rests = planned(fall, {"gravity=[0,0,0]", "wall=[]"});
    const Planned falls = planned(fall, {"wall=[]"});
    const Planned flies = planned(fall, {"wall=[]", "body[0].velocity=[1,1,0]"});
    constexpr double row = 18.5; // a number of full length in the place of a zero [B]
    const double rows = 1001;
    // Along z: place, velocity and momentum; both energies' part, and the impulse of gravity.
    EXPECT_NEAR(disk(falls) - disk(rests), rows * row * 5, 0.15 * rows * row * 5);
    EXPECT_NEAR(disk(flies) - disk(falls), rows * row * 6, 0.15 * rows * row * 6);
}

// Walls that move are written with every frame.
TEST(Forecast, OfMovingWallsIsThatOfTheirLattice)
{
    const Planned p = planned(tank);
    ASSERT_GT(p.plan.counts.wall, 10000);
    const Planned moved = planned(tank, {"wall[0].motion.velocity=[0.1,0,0]"});
    ASSERT_EQ(moved.plan.counts.wall, p.plan.counts.wall);
    const auto walls = static_cast<double>(p.plan.counts.wall);
    const double of_frame = (disk(moved) - disk(p)) / p.plan.frames;
    EXPECT_GT(of_frame, 5 * walls);
    EXPECT_LT(of_frame, 25 * walls) << "of 62 bytes before compression";
}

TEST(Forecast, OfMoreStillWallsIsNextToNothing)
{
    const Planned low = planned(tank);
    const Planned high = planned(tank, {"wall[0].max=[0.6,0.6,2.4]"});
    const auto more = static_cast<double>(high.plan.counts.wall - low.plan.counts.wall);
    ASSERT_GT(more, 10000);
    EXPECT_LT((disk(high) - disk(low)) / more, 6) << "of 62 bytes before compression";
    EXPECT_GT(disk(high), disk(low));
}

TEST(Forecast, OfFramesFollowsTheFluidThatIsLeft)
{
    const Planned p = planned(tank);
    const double all = disk(p);
    const double half = disk(p, {.fluid = 0.5, .fluid_end = 0.5});
    EXPECT_LT(half, 0.75 * all) << "frames and the last checkpoint halve, walls and texts do not";
    EXPECT_GT(half, 0.5 * all);
}

// Both checkpoints keep the correction of the gradient, six numbers, and that of the divergence
// with its rate; frames do not.
TEST(Forecast, OfCheckpointsHasTheColumnsOfTheCase)
{
    const Planned plain = planned(tank, {"fluid.gradient=plain"});
    const Planned corrected = planned(tank, {"fluid.gradient=corrected"});
    const double rows = 2 * static_cast<double>(plain.plan.counts.fluid);
    EXPECT_NEAR((disk(corrected) - disk(plain)) / rows, 8 * 8, 4);
}

// Carpets are in both checkpoints, and in no frame.
TEST(Forecast, OfAnOpenSideCountsItsCarpet)
{
    const std::vector<std::string> door{"wall[0].open=[\"+z\",\"-x\"]"};
    const Planned shut = planned(tank, door);
    const Planned open = planned(tank + R"([[open]]
name = "sea"
min = [0.0, 0.0, 0.0]
max = [0.0, 0.6, 0.8]
into = "+x"
kind = "absorb"
)",
                                 door);
    ASSERT_EQ(open.plan.open.size(), 1U);
    const double carpet = 2 * static_cast<double>(open.plan.open[0].carpet) * 136;
    EXPECT_GT(disk(open) - disk(shut), 0.5 * carpet);
    EXPECT_LT(disk(open) - disk(shut), carpet + 60e3) << "with open.csv and its datasets";
}

// Each force gauge with a filter has 21 columns in gauges.csv and results.h5, and names.
TEST(Forecast, OfShortRunsCountsGaugesAndTexts)
{
    std::string gauges;
    for (int k = 0; k < 10; ++k) {
        gauges += "[[gauge]]\nname = \"force_" + std::to_string(k) +
                  "\"\ntype = \"force\"\non = \"basin\"\n"
                  "filter = \"exponential\"\nwindow = 0.05\n";
    }
    const Planned without = planned(tank);
    const Planned with = planned(tank + gauges, {"output.gauge_every=0.05"});
    // Of 210 columns, three rows: 440 B around each in results.h5, 30 of its name and unit, 60 of
    // numbers as text and 24 as numbers, twice the plan's 500 B of a gauge, four times its case.
    EXPECT_NEAR(disk(with) - disk(without), 210 * (440 + 30 + 60 + 24) + 10 * 1400 + 10e3, 35e3);
}

TEST(Forecast, OfMemoryIsThatOfTheProgramAndWhatItHolds)
{
    const Planned box = planned(fall);
    EXPECT_NEAR(box.plan.memory, 18e6, 2e6) << "the program with its libraries";
    const Planned fine = planned(tank, {"particles.spacing=0.01"});
    const Planned coarse = planned(tank);
    const auto more =
        static_cast<double>(fine.plan.counts.particles() - coarse.plan.counts.particles());
    const double each = (fine.plan.memory - coarse.plan.memory) / more;
    EXPECT_GT(each, 400) << "a wall particle";
    EXPECT_LT(each, 850) << "a fluid particle with its lists, states and frames";
}

} // namespace
} // namespace hyoryu::test_forecast
