// SPDX-License-Identifier: MIT
// Walls far from water are places without rows: they cost no columns, and no result knows of them.
#include "hyoryu/sim/frames.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace hyoryu::test_dry_walls {
namespace {

// A column of water in a long flume, with what follows it.
std::string flume(int dimensions, double spacing, const std::string& more = "")
{
    const double y = dimensions == 2 ? 0 : 0.3;
    return fmt::format(R"(
dimensions = {0}
[time]
end = 10.0
[particles]
spacing = {1}
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.3, {2}, 0.4]
[[wall]]
name = "flume"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [3.0, {2}, 1.0]
open = ["+z"]
[[body]]
shape = "box"
size = [0.1, 0.1, 0.1]
density = 500.0
position = [0.7, {3}, 0.05]
{4})",
                       dimensions, spacing, y, y / 2, more);
}

// The wall particles within a distance of any fluid particle, from the filling alone.
std::set<std::int64_t> walls_near(const Simulation& sim, const Filling& filling, double distance)
{
    std::set<std::int64_t> near;
    const auto x = std::as_const(*sim.fluid).particles.fluid[field::position];
    for (std::size_t k = 0; k < filling.wall.size(); ++k) {
        const auto is_near = [&](const Vec3& p) { return (p - filling.wall[k]).norm() < distance; };
        if (std::ranges::any_of(x, is_near)) {
            near.insert(static_cast<std::int64_t>(filling.fluid.size() + k));
        }
    }
    return near;
}

class DryWalls : public testing::TestWithParam<std::tuple<int, double>> {
protected:
    Simulation made(const std::string& more = "") const
    {
        return make(flume(std::get<0>(GetParam()), std::get<1>(GetParam()), more));
    }
};

TEST_P(DryWalls, GetRowsWhenWaterComesNear)
{
    Simulation sim = made();
    const Filling filling = fill(sim.scene);
    const Store& walls = sim.fluid->particles.wall;
    const Index first = walls.size();
    EXPECT_LT(first, static_cast<Index>(filling.wall.size()) / 2);
    std::set<std::int64_t> wet;
    for (int k = 0; k < 10; ++k) {
        advance(sim, 100);
        const auto ids = std::as_const(walls).id();
        const std::set<std::int64_t> with_rows(ids.begin(), ids.end());
        ASSERT_EQ(with_rows.size(), at(walls.size()));
        wet.insert(with_rows.begin(), with_rows.end());
        // Lists know pairs within the support; nothing that is nearer may be missing.
        for (const std::int64_t number : walls_near(sim, filling, sim.fluid->kernel.support)) {
            ASSERT_TRUE(with_rows.contains(number)) << "step " << sim.clock.step;
        }
        for (Index row = 0; row < walls.size(); ++row) {
            const auto place = at(walls.id()[row]) - filling.fluid.size();
            ASSERT_EQ(walls[field::position][row], filling.wall[place]);
            ASSERT_EQ(walls.owner()[row], -1 - filling.wall_owner[place]);
        }
    }
    EXPECT_GT(wet.size(), at(first)); // the water has come to others
}

TEST_P(DryWalls, FarAwayCostNoRowAndChangeNoBit)
{
    const std::string far = "[domain]\nmin = [-1.0, -1.0, -1.0]\nmax = [20.0, 5.0, 5.0]\n";
    const std::string tower = "[[wall]]\nname = \"tower\"\nshape = \"box\"\n"
                              "min = [10.0, 0.0, 0.0]\nmax = [12.0, 2.0, 2.0]\n";
    Simulation without = made(far);
    Simulation with = made(far + tower);
    ASSERT_GT(with.plan.counts.wall, without.plan.counts.wall);
    advance(with, 100);
    advance(without, 100);
    EXPECT_EQ(with.fluid->particles.wall.size(), without.fluid->particles.wall.size());
    EXPECT_EQ(with.fluid->particles.wall.bytes(), without.fluid->particles.wall.bytes());
    EXPECT_EQ(save(with).arrays.at("fluid/Position").values,
              save(without).arrays.at("fluid/Position").values);
}

TEST_P(DryWalls, ArePartOfTheFrame)
{
    Simulation sim = made();
    const Filling filling = fill(sim.scene);
    advance(sim, 60);
    const Cloud cloud = wall_cloud(sim);
    ASSERT_EQ(cloud.points.size(), 3 * filling.wall.size());
    for (std::size_t k = 0; k < filling.wall.size(); ++k) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            ASSERT_EQ(cloud.points[3 * k + axis],
                      static_cast<float>(filling.wall[k][static_cast<Index>(axis)]));
        }
    }
    const auto column = [&](const std::string& name) -> const Column& {
        return *std::ranges::find(cloud.columns, name, &Column::name);
    };
    const auto& p = std::get<std::vector<float>>(column("Pressure").values);
    const auto& rho = std::get<std::vector<float>>(column("Density").values);
    ASSERT_EQ(p.size(), filling.wall.size());
    EXPECT_GT(*std::ranges::max_element(p), 0);
    EXPECT_FLOAT_EQ(rho.back(), static_cast<float>(sim.fluid->parameters.eos.rho0)); // far and dry
}

// Friction acts a step later, on rows that a restart has to find again.
TEST_P(DryWalls, ResumeWithTheSameBits)
{
    for (const char* gate :
         {"", "[[wall]]\nname = \"gate\"\nshape = \"box\"\nmin = [0.4, 0.0, 0.05]\n"
              "max = [0.5, 0.3, 0.6]\n[wall.motion]\nvelocity = [0, 0, 0.3]\n"}) {
        const std::string sticky = "[fluid.viscosity]\nmodel = \"laminar\"\nkinematic = 1e-3\n";
        Simulation whole =
            make(flume(std::get<0>(GetParam()), std::get<1>(GetParam()), sticky + gate),
                 {"fluid.walls=no_slip"});
        Simulation begun = make(to_toml(whole.scene));
        advance(whole, 170);
        advance(begun, 83);
        Simulation resumed = make_blank(to_toml(whole.scene));
        restore(resumed, save(begun));
        advance(resumed, 87);
        EXPECT_EQ(resumed.fluid->particles.wall.size(), whole.fluid->particles.wall.size());
        expect_same_bits(save(resumed), save(whole));
    }
}

std::string name_of(const testing::TestParamInfo<std::tuple<int, double>>& scene)
{
    const auto [dimensions, spacing] = scene.param;
    return fmt::format("{}d_{}um", dimensions, std::lround(1e6 * spacing));
}

INSTANTIATE_TEST_SUITE_P(Scenes, DryWalls,
                         testing::Values(std::tuple(2, 0.02), std::tuple(2, 0.0131),
                                         std::tuple(3, 0.05), std::tuple(3, 0.037)),
                         name_of);

} // namespace
} // namespace hyoryu::test_dry_walls
