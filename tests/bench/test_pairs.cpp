// SPDX-License-Identifier: MIT
// Pairs counted in neighbour lists, held against all pairs that there are.
#include "bench/dam_break.hpp"
#include "bench/pairs.hpp"

#include "hyoryu/scene/case_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <span>

namespace hyoryu::bench {
namespace {

/// Directed pairs of different particles, one of each set, within the support.
double all_pairs(const Fluid& fluid, std::span<const Vec3> from, std::span<const Vec3> to)
{
    double pairs = 0;
    for (const Vec3& a : from) {
        for (const Vec3& b : to) {
            pairs += &a != &b && (a - b).squaredNorm() < sq(fluid.kernel.support) ? 1 : 0;
        }
    }
    return pairs;
}

/// Makes lists of the present positions and compares their pairs.
void expect_all_pairs(Simulation& sim, bool with_bodies)
{
    make_lists(*sim.fluid);
    const Fluid& fluid = *sim.fluid;
    const auto x = fluid.particles.fluid[field::position];
    const double of_walls = all_pairs(fluid, x, fluid.particles.wall[field::position]);
    const double of_bodies = all_pairs(fluid, x, fluid.particles.body[field::position]);
    EXPECT_GT(of_walls, 0);
    EXPECT_EQ(of_bodies > 0, with_bodies);
    EXPECT_EQ(pairs_within_support(fluid, fluid.neighbours.fluid_fluid), all_pairs(fluid, x, x));
    EXPECT_EQ(pairs_within_support(fluid, fluid.neighbours.fluid_solid), of_walls + of_bodies);
}

TEST(PairsWithinSupport, OfADamBreak)
{
    Simulation sim = make_dam_break(std::cbrt(reference_volume / 1e3));
    develop(sim, 0.1, {});
    expect_all_pairs(sim, false);
}

TEST(PairsWithinSupport, OfADamBreakOntoABody)
{
    constexpr const char* crate = R"toml(
title = "Dam break onto a crate"
[time]
end = 100.0
[particles]
spacing = 0.05
[fluid]
sound_speed = 34.3
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.4, 0.4, 0.4]
[[wall]]
name = "tank"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [1.2, 0.4, 0.6]
open = ["+z"]
[[body]]
name = "crate"
shape = "box"
size = [0.2, 0.2, 0.2]
density = 500.0
position = [0.55, 0.2, 0.1]
[output]
every = 100.0
)toml";
    const Scene scene = parse_case(crate, "crate");
    const Filling filling = fill(scene);
    Simulation sim = make_simulation(scene, make_plan(scene, filling), filling);
    develop(sim, 0.1, {});
    expect_all_pairs(sim, true);
}

} // namespace
} // namespace hyoryu::bench
