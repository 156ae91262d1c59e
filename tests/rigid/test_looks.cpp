// SPDX-License-Identifier: MIT
// What is known of pairs from earlier looks must never show: bodies that are looked at anew in
// every step move with the same bits.
#include "dice.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

namespace hyoryu::test_looks {
namespace {

using namespace test;

Motion to_and_fro(const Vec3& way)
{
    return {Vec3::Zero(), {0, 0.1, 0.15, 0.25}, {Vec3::Zero(), way, way, Vec3::Zero()}};
}

ContactShape shape_of(int kind, const Vec3& size)
{
    if (kind == 0) {
        return Ball{size.x() / 2};
    }
    return box_polytope(size, 3);
}

// Boxes and balls at random on a floor, between a plate and a plane that push them and go back.
Rigid pushed(int seed)
{
    Dice dice(seed);
    const double friction = dice.between(0, 0.6);
    Rigid rigid = on_floor(friction, dice.between(0, 0.8));
    rigid.boundaries.push_back({"plate", Obstacle{box_polytope({0.1, 2, 2}, 3), {-0.3, 0, 0}}, 0,
                                to_and_fro({0.1, 0, 0})});
    rigid.boundaries.push_back(
        {"piston", Plane{{0.3, 0, 0}, -Vec3::UnitX()}, 0, to_and_fro({-0.05, 0, 0})});
    if (seed % 3 == 0) { // all lie still until a wall comes, which alone has moved then
        rigid.settings.gravity.setZero();
    }
    for (int k = 0; k < 6; ++k) {
        const Vec3 size = Vec3::Constant(0.07) + dice.within(0.02);
        const Vec3 place(0.14 * (k % 3 - 1), dice.between(-0.01, 0.01), 0.07 + 0.13 * (k / 3));
        rigid.bodies.push_back(body_of(shape_of(k % 4 == 3 ? 0 : 1, size), 400, place));
        rigid.bodies.back().orientation = k < 3 ? Quat::Identity() : dice.turn();
    }
    return rigid;
}

void expect_same_bits(const Rigid& one, const Rigid& other)
{
    for (std::size_t k = 0; k < one.bodies.size(); ++k) {
        ASSERT_EQ(one.bodies[k].position, other.bodies[k].position);
        ASSERT_EQ(one.bodies[k].orientation.coeffs(), other.bodies[k].orientation.coeffs());
        ASSERT_EQ(one.bodies[k].velocity, other.bodies[k].velocity);
    }
}

class LooksOfSeed : public testing::TestWithParam<int> {};

TEST_P(LooksOfSeed, DoNotShowWhereBodiesAndWallsMoveAndRest)
{
    Dice dice(GetParam());
    const double dt = dice.between(5e-4, 5e-3);
    Rigid one = pushed(GetParam());
    Rigid other = pushed(GetParam());
    for (int n = 0; n * dt < 0.4; ++n) {
        run(one, dt, 1, {}, n * dt);
        set_contact_start(other, contact_start(other)); // forgets all looks
        run(other, dt, 1, {}, n * dt);
        expect_same_bits(one, other);
        ASSERT_FALSE(HasFatalFailure()) << "step " << n;
    }
}

INSTANTIATE_TEST_SUITE_P(Family, LooksOfSeed, testing::Range(1, 13));

} // namespace
} // namespace hyoryu::test_looks
