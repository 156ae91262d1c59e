// SPDX-License-Identifier: MIT
// Particles of the fluid at one place (fluid notes, hard case 22). A case makes none: of blocks
// that overlap the second leaves out what the first has filled.
#include "runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace hyoryu::test_one_place {
namespace {

constexpr const char* tank = R"(
dimensions = 2
[time]
end = 10.0
[particles]
spacing = 0.02
[fluid]
sound_speed = 20.0
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.4, 0.0, 0.3]
[[wall]]
name = "basin"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [0.4, 0.0, 0.5]
open = ["+z"]
)";

std::size_t row_of(const Simulation& sim, std::int64_t id)
{
    const auto ids = sim.fluid->particles.fluid.id();
    return static_cast<std::size_t>(std::ranges::find(ids, id) - ids.begin());
}

Vec3 place_of(const Simulation& sim, std::int64_t id)
{
    return sim.fluid->particles.fluid[field::position][row_of(sim, id)];
}

// Two particles of still water, of which the second is put where the first is.
Simulation doubled(const char* formulation, std::int64_t one, std::int64_t other)
{
    Simulation sim = make(tank, {fmt::format("fluid.formulation={}", formulation)});
    sim.fluid->particles.fluid[field::position][row_of(sim, other)] = place_of(sim, one);
    return sim;
}

TEST(OnePlace, TwoParticlesPart)
{
    for (const char* formulation : {"sph", "mps"}) {
        for (const auto& [one, other] : {std::pair(150, 151), {0, 1}, {10, 299}}) {
            Simulation sim = doubled(formulation, one, other);
            advance(sim, 600);
            const double apart = (place_of(sim, one) - place_of(sim, other)).norm();
            EXPECT_GE(apart, 0.01) << formulation << ' ' << one << ": half a spacing";
            EXPECT_EQ(sim.fluid->lost.count, 0);
            double fastest = 0;
            for (const Vec3& v : sim.fluid->particles.fluid[field::velocity]) {
                fastest = std::max(fastest, v.norm());
            }
            EXPECT_LE(fastest, 0.5) << formulation << ' ' << one; // a spacing falls at 0.6 m/s
        }
    }
}

TEST(OnePlace, SeveralPartTheSameWayInEveryRun)
{
    const auto snapshot_of_three = [](int threads) {
        set_threads(threads);
        Simulation sim = doubled("sph", 150, 151);
        sim.fluid->particles.fluid[field::position][row_of(sim, 40)] = place_of(sim, 150);
        advance(sim, 200);
        EXPECT_GT((place_of(sim, 150) - place_of(sim, 151)).norm(), 1e-3);
        EXPECT_GT((place_of(sim, 150) - place_of(sim, 40)).norm(), 1e-3);
        EXPECT_GT((place_of(sim, 151) - place_of(sim, 40)).norm(), 1e-3);
        set_threads(0);
        return save(sim);
    };
    const Snapshot one = snapshot_of_three(1);
    expect_same_bits(one, snapshot_of_three(3));
}

} // namespace
} // namespace hyoryu::test_one_place
