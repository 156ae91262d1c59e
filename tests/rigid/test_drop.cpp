// SPDX-License-Identifier: MIT
// Flat drops of the cube against the piecewise parabola (contact notes, table (a); test T1).
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hyoryu::test_drop {
namespace {

using namespace test;

constexpr double e = 0.75;

// Height of the centre at time t: parabolas between bounces, rest after the last.
double exact_height(double t, double fall, double rest)
{
    double v = std::sqrt(2 * g * fall);
    double start = v / g;
    if (t < start) {
        return rest + fall - 0.5 * g * t * t;
    }
    for (int bounce = 0; bounce < 200; ++bounce) {
        v *= e;
        const double s = t - start;
        if (s < 2 * v / g) {
            return rest + v * s - 0.5 * g * s * s;
        }
        start += 2 * v / g;
    }
    return rest;
}

class FlatDrop : public testing::TestWithParam<std::tuple<double, int>> {};

TEST_P(FlatDrop, FollowsTheParabolasAndComesToRest)
{
    const auto [fall, dimensions] = GetParam();
    Rigid rigid = on_floor(e, 0.3, dimensions);
    const double rest = 0.025;
    rigid.bodies.push_back(box(cube_size(), 250, {0, 0, rest + fall}, dimensions));
    const double dt = 1e-3;
    double square = 0;
    const Body& cube = rigid.bodies[0];
    run(rigid, dt, 1200,
        [&](double t) { square += sq(cube.position.z() - exact_height(t, fall, rest)); });
    EXPECT_LE(std::sqrt(square / 1200), 1e-6);
    EXPECT_LE(std::abs(cube.position.x()), 1e-12);
    EXPECT_LE(cube.orientation.vec().norm(), 1e-9);
    EXPECT_LE(cube.velocity.norm(), 2e-3);
    const Vec3 settled = cube.position;
    run(rigid, dt, 1000, {}, 1.2);
    EXPECT_LE((cube.position - settled).norm(), 1e-9);
    EXPECT_NEAR(cube.position.z(), rest, 1e-9);
}

// Bottom face, centre, or particle 10 cm above the wall.
INSTANTIATE_TEST_SUITE_P(Heights, FlatDrop,
                         testing::Combine(testing::Values(0.100, 0.075, 0.090),
                                          testing::Values(3, 2)));

} // namespace
} // namespace hyoryu::test_drop
