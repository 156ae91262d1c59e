// SPDX-License-Identifier: MIT
// Columns exist only if asked for; removing and sorting rows keeps every column together.
#include "hyoryu/core/particles.hpp"

#include <gtest/gtest.h>

namespace hyoryu {
namespace {

TEST(Particles, OnlyTheListedColumnsExist)
{
    Particles particles;
    particles.allocate(Fields<Position, Density>{}, 3, 2, 1);
    EXPECT_TRUE(particles.has(field::position));
    EXPECT_FALSE(particles.has(field::viscous_force));
    ASSERT_EQ(particles.active_columns().size(), 2u);
    EXPECT_EQ(particles.active_columns()[0].bytes_per_particle, 24u);
    EXPECT_EQ(particles.size(), 6);
}

TEST(Particles, SortingAndDroppingMovesAllColumnsAlike)
{
    Particles particles;
    particles.allocate(Fields<Density, Pressure>{}, 4, 1, 1);
    for (std::size_t k = 0; k < 6; ++k) {
        particles[field::density][k] = static_cast<real>(k);
        particles[field::pressure][k] = 10 * static_cast<real>(k);
        particles.id()[k] = static_cast<std::int64_t>(k);
    }
    const std::int32_t order[] = {2, 0, 3}; // row 1 leaves
    particles.permute_fluid(order);
    ASSERT_EQ(particles.size(), 5);
    EXPECT_EQ(particles.fluid().size(), 3);
    EXPECT_EQ(particles.wall().begin, 3);
    EXPECT_EQ(particles.body().end, 5);
    const real expected[] = {2, 0, 3, 4, 5};
    for (std::size_t k = 0; k < 5; ++k) {
        EXPECT_EQ(particles[field::density][k], expected[k]);
        EXPECT_EQ(particles[field::pressure][k], 10 * expected[k]);
        EXPECT_EQ(particles.id()[k], static_cast<std::int64_t>(expected[k]));
    }
}

TEST(Particles, SolidsHaveNoRoomForWhatIsOfFluidAlone)
{
    Particles particles;
    particles.allocate(Fields<Density, DensityRate>{}, 3, 2, 1);
    ASSERT_EQ(particles[field::density].size(), 6u);
    ASSERT_EQ(particles[field::density_rate].size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) {
        particles[field::density_rate][k] = static_cast<real>(k);
    }
    const std::int32_t order[] = {2, 0}; // row 1 leaves
    std::vector<std::byte> room(2 * sizeof(Vec3));
    particles.permute_fluid(order, room);
    ASSERT_EQ(particles[field::density_rate].size(), 2u);
    EXPECT_EQ(particles[field::density_rate][0], 2);
    EXPECT_EQ(particles[field::density_rate][1], 0);
    EXPECT_EQ(particles[field::density].size(), 5u);
}

TEST(Fields, UnionKeepsOrderAndHasNoTwins)
{
    using U = Union<Fields<Position, Density>, Fields<Density, Velocity>, Fields<>>;
    static_assert(std::is_same_v<U, Fields<Position, Density, Velocity>>);
    static_assert(U::scalars == 7);
    static_assert(offset<Velocity, U> == 4);
}

TEST(Parallel, SumsDoNotDependOnTheNumberOfThreads)
{
    const auto total = [] {
        return sum(0, 100000, 0.0, [](Index k) { return 1.0 / static_cast<double>(k + 1); });
    };
    set_threads(1);
    const double one = total();
    for (const int threads : {2, 3, 5}) {
        set_threads(threads);
        EXPECT_EQ(total(), one);
    }
    set_threads(0);
    EXPECT_NEAR(one, 12.090146129863428, 1e-10); // harmonic number of 1e5
}

} // namespace
} // namespace hyoryu
