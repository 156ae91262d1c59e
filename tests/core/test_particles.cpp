// SPDX-License-Identifier: MIT
// Columns exist only if asked for; removing and sorting rows keeps every column together.
#include "hyoryu/core/particles.hpp"

#include <gtest/gtest.h>

namespace hyoryu::test_particles {
namespace {

// A field that an effect brings along.
struct Colour {
    using type = real;
    static constexpr FieldInfo info{"Colour", "1", Holders::solids};
};
constexpr Colour colour{};

TEST(Particles, OnlyTheListedColumnsExist)
{
    Particles particles;
    reset(particles, 3, 2, 1);
    add_columns(particles, Fields<Position, Density>{});
    for (const Store* store : {&particles.fluid, &particles.wall, &particles.body}) {
        EXPECT_TRUE(store->has(field::position));
        EXPECT_FALSE(store->has(field::viscous_force));
        EXPECT_EQ((*store)[field::density].size(), static_cast<std::size_t>(store->size()));
    }
    ASSERT_EQ(active_columns(particles).size(), 2u);
    EXPECT_EQ(active_columns(particles)[0].bytes_per_particle, 24u);
    EXPECT_EQ(particles.size(), 6);
    EXPECT_EQ(particles.solids(), 3);
}

TEST(Particles, NumbersGoOnFromKindToKind)
{
    Particles particles;
    reset(particles, 3, 2, 1);
    EXPECT_EQ(particles.fluid.id()[2], 2);
    EXPECT_EQ(particles.wall.id()[0], 3);
    EXPECT_EQ(particles.body.id()[0], 5);
}

TEST(Particles, SortingAndDroppingMovesAllColumnsAlikeAndNoOtherStore)
{
    Particles particles;
    reset(particles, 4, 2, 1);
    add_columns(particles, Fields<Density, Pressure, Velocity>{});
    for (Store* store : {&particles.fluid, &particles.wall}) {
        for (Index k = 0; k < store->size(); ++k) {
            (*store)[field::density][k] = static_cast<real>(store->id()[k]);
            (*store)[field::pressure][k] = 10 * static_cast<real>(store->id()[k]);
            (*store)[field::velocity][k].x() = 100 * static_cast<real>(store->id()[k]);
        }
    }
    const std::int32_t order[] = {2, 0, 3}; // row 1 leaves
    std::vector<std::byte> room(3 * sizeof(Vec3));
    particles.fluid.gather(order, room);
    ASSERT_EQ(particles.size(), 6);
    ASSERT_EQ(particles.fluid.size(), 3);
    const real expected[] = {2, 0, 3};
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(particles.fluid[field::density][k], expected[k]);
        EXPECT_EQ(particles.fluid[field::pressure][k], 10 * expected[k]);
        EXPECT_EQ(particles.fluid[field::velocity][k].x(), 100 * expected[k]);
        EXPECT_EQ(particles.fluid.id()[k], static_cast<std::int64_t>(expected[k]));
    }
    EXPECT_EQ(particles.wall[field::density][1], 5); // as it was
}

TEST(Particles, GatheringMakesRowsThatComeBack)
{
    Store store(Kind::wall);
    store.reset(3);
    store.add(Fields<Density, Velocity>{});
    for (Index k = 0; k < 3; ++k) {
        store.id()[k] = 7 + k;
        store.owner()[k] = -1;
        store[field::density][k] = static_cast<real>(k + 1);
        store[field::velocity][k].setConstant(static_cast<real>(k + 1));
    }
    const std::int32_t from[] = {-1, 2, -1, 0, -1, 1};
    store.gather(from);
    const real expected[] = {0, 3, 0, 1, 0, 2};
    ASSERT_EQ(store.size(), 6);
    for (std::size_t k = 0; k < 6; ++k) {
        EXPECT_EQ(store[field::density][k], expected[k]);
        EXPECT_EQ(store[field::velocity][k], Vec3(Vec3::Constant(expected[k])));
        EXPECT_EQ(store.id()[k], from[k] < 0 ? 0 : 7 + from[k]);
        EXPECT_EQ(store.owner()[k], from[k] < 0 ? 0 : -1);
    }
    store.gather({});
    EXPECT_EQ(store.size(), 0);
    EXPECT_TRUE(store.has(field::density)); // columns stay
}

TEST(Particles, AFieldExistsOnlyOnTheKindsThatHoldIt)
{
    Particles particles;
    reset(particles, 3, 2, 1);
    add_columns(particles, Fields<Density, DensityRate, Colour>{});
    EXPECT_TRUE(particles.fluid.has(field::density_rate));
    EXPECT_FALSE(particles.wall.has(field::density_rate));
    EXPECT_FALSE(particles.fluid.has(colour));
    EXPECT_TRUE(particles.body.has(colour));
    particles.body[colour][0] = 7;
    EXPECT_EQ(particles.body.pointers()[colour][0], 7);
    EXPECT_EQ(particles.fluid.pointers()[colour], nullptr);
    EXPECT_EQ(active_columns(particles).size(), 3u);
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
} // namespace hyoryu::test_particles
