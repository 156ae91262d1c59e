// SPDX-License-Identifier: MIT
// How bodies float, against the classical results for logs and boxes.
#include "hyoryu/scene/flotation.hpp"

#include "dice.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace hyoryu::test_flotation {
namespace {

constexpr double degree = std::numbers::pi / 180;
const Vec3 down(0, 0, -9.81);

BodySettings box(const Vec3& size, double mass, const Vec3& centre)
{
    BodySettings body;
    body.shape = BoxShape{size};
    body.mass = mass;
    body.density = mass / size.prod();
    body.centre_of_mass = centre;
    return body;
}

// A long log of square section turns to atan(1/2) at a quarter of the density of water, and to 45
// degrees between 0.281 and 0.719 (Gilbert 1991).
TEST(Flotation, SquareLogsLieAsGilbertFound)
{
    const struct {
        double density, degrees;
    } known[] = {{0.15, 0}, {0.25, std::atan(0.5) / degree}, {0.3, 45}, {0.5, 45}, {0.9, 0}};
    for (const auto& log : known) {
        for (const int dimensions : {2, 3}) {
            BodySettings body;
            body.shape = BoxShape{Vec3(1, 20, 1)};
            body.mass = (dimensions == 2 ? 1000 : 20000) * log.density;
            const auto floating = flotation(body, 1000, down, dimensions);
            ASSERT_TRUE(floating);
            // The search ends where the next turn is below 1e-7 rad; the state is a flat minimum.
            EXPECT_NEAR(floating->tilt / degree, log.degrees, 0.05) << log.density << dimensions;
            EXPECT_GT(floating->at_rest.metacentre, 0);
        }
    }
}

// A cylinder that lies has the draft of its section and is neutral about its axis; a sphere is
// neutral about every axis.
TEST(Flotation, RoundBodiesLieAtTheDraftOfTheirSection)
{
    Dice dice(static_cast<std::uint64_t>(number_from("HYORYU_SEED", 9)));
    for (int k = 0; k < 20; ++k) {
        const double radius = dice.between(0.1, 2);
        const double half = dice.between(0.6, 2.6); // angle of the wet arc over 2
        const double share = (half - std::sin(half) * std::cos(half)) / std::numbers::pi;
        BodySettings body;
        body.shape = CylinderShape{radius, 12 * radius};
        body.mass = 1000 * share * std::numbers::pi * radius * radius * 12 * radius;
        const auto lying = flotation(body, 1000, down, 3);
        ASSERT_TRUE(lying);
        // 32 sides: half a per cent of the radius.
        EXPECT_NEAR(lying->as_placed.draft, radius * (1 - std::cos(half)), 0.01 * radius) << share;
        EXPECT_EQ(lying->as_placed.metacentre, 0) << share;
        EXPECT_LT(lying->tilt / degree, 0.1) << share;
        body.shape = SphereShape{radius};
        body.mass = 1000 * share * 4 * std::numbers::pi * radius * radius * radius / 3;
        const auto ball = flotation(body, 1000, down, 3);
        ASSERT_TRUE(ball);
        EXPECT_EQ(ball->as_placed.metacentre, 0) << share;
        EXPECT_LT(ball->tilt / degree, 0.1) << share;
    }
}

// B^2 / (12 d) + d / 2 - KG of an upright box with its centre of mass anywhere on its axis.
TEST(Flotation, BoxesWithCargoHaveTheMetacentricHeightOfTheirFormula)
{
    Dice dice(26);
    for (int n = 0; n < 40; ++n) {
        const Vec3 size{dice.between(1, 5), dice.between(1, 5), dice.between(0.5, 3)};
        const double share = dice.between(0.05, 0.9);
        const double z = dice.between(-0.45, 0.45) * size.z();
        const BodySettings body = box(size, 1000 * share * size.prod(), Vec3(0, 0, z));
        const auto floating = flotation(body, 1000, down, 3);
        ASSERT_TRUE(floating);
        const double draft = share * size.z();
        const double breadth = std::min(size.x(), size.y());
        const double gm = sq(breadth) / (12 * draft) + draft / 2 - (size.z() / 2 + z);
        EXPECT_NEAR(floating->as_placed.draft, draft, 1e-9);
        EXPECT_NEAR(floating->as_placed.metacentre, gm, 1e-6 * size.norm()); // of differences
        EXPECT_EQ(floating->tilt > degree, gm < 0) << n;
    }
}

TEST(Flotation, WhatIsHeavierThanWaterDoesNotFloat)
{
    EXPECT_FALSE(flotation(box({1, 1, 1}, 1001, {0, 0, 0}), 1000, down, 3));
    EXPECT_FALSE(flotation(box({1, 1, 1}, 500, {0, 0, 0}), 1000, Vec3(0, 0, 0), 3));
}

} // namespace
} // namespace hyoryu::test_flotation
