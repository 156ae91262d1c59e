// SPDX-License-Identifier: MIT
// Sliding, sticking and rolling (contact notes, scenes (b), (f), (g); tests T6, T11, T12).
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hyoryu::test_slide {
namespace {

using namespace test;

class Slide : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(Slide, StopsWhereCoulombSays)
{
    const auto [mu, heading] = GetParam();
    Rigid rigid = on_floor(0.75, mu);
    rigid.bodies.push_back(box(cube_size(), 250, {0, 0, 0.025}));
    const double angle = heading * 3.14159265358979323846 / 180;
    const Vec3 direction(std::cos(angle), std::sin(angle), 0);
    Body& cube = rigid.bodies[0];
    cube.velocity = direction;
    // the last sliding step tells the stopping time: u / (mu g) remains
    const double t_stop = 1 / (mu * g);
    double stop = 0;
    run(rigid, 1e-3, static_cast<int>(t_stop / 1e-3) + 20, [&](double t) {
        const double u = cube.velocity.norm();
        stop = u > 1e-6 ? t + u / (mu * g) : stop;
    });
    EXPECT_NEAR(stop, t_stop, 1e-6 * t_stop);
    const double distance = cube.position.head<2>().norm();
    EXPECT_NEAR(distance, 1 / (2 * mu * g), 1e-5 * distance);
    EXPECT_LE(std::abs(cube.position.cross(direction).z()), 1e-9 * distance);
}

INSTANTIATE_TEST_SUITE_P(Headings, Slide,
                         testing::Combine(testing::Values(0.1, 0.2, 0.3, 0.5),
                                          testing::Values(0.0, 30.0, 45.0)));

TEST(SlideInPlane, StopsWhereCoulombSays)
{
    Rigid rigid = on_floor(0.75, 0.3, 2);
    rigid.bodies.push_back(box(cube_size(), 250, {0, 0, 0.025}, 2));
    rigid.bodies[0].velocity = {1, 0, 0};
    run(rigid, 1e-3, 400);
    const double distance = 1 / (2 * 0.3 * g);
    EXPECT_NEAR(rigid.bodies[0].position.x(), distance, 1e-5 * distance);
    EXPECT_EQ(rigid.bodies[0].position.y(), 0);
}

// The brick 0.2 x 0.1 x 0.06 m on a slope of 30 degrees, turned about the normal by the heading.
Rigid brick_on_slope(double mu, double heading)
{
    Rigid rigid = scene(0.0, mu);
    const Quat slope = turn_about(Vec3::UnitY(), 30);
    const Vec3 normal = slope * Vec3::UnitZ();
    rigid.boundaries.push_back({"slope", Plane{Vec3::Zero(), normal}});
    rigid.bodies.push_back(box({0.2, 0.1, 0.06}, 1000, 0.03 * normal));
    rigid.bodies[0].orientation = slope * turn_about(Vec3::UnitZ(), heading);
    return rigid;
}

TEST(Slope, SlidesWithTheExactAcceleration)
{
    for (const double heading : {0.0, 45.0}) {
        Rigid rigid = brick_on_slope(0.57, heading);
        const Vec3 start = rigid.bodies[0].position;
        run(rigid, 1e-3, 2000);
        const double a = 2 * (rigid.bodies[0].position - start).norm() / sq(2.0);
        EXPECT_NEAR(a, 0.062446, 1e-5 * 0.062446 + 5e-7); // the last digit of the notes
    }
}

TEST(Slope, SticksWithoutCreep)
{
    Rigid rigid = brick_on_slope(0.58, 0);
    const Vec3 start = rigid.bodies[0].position;
    run(rigid, 1e-3, 10000);
    EXPECT_LE((rigid.bodies[0].position - start).norm(), 1e-7);
}

TEST(Roll, SkidTurnsIntoRolling)
{
    Rigid rigid = on_floor(0.0, 0.2);
    rigid.bodies.push_back(body_of(Ball{0.1}, 1000, {0, 0, 0.1}));
    rigid.bodies[0].velocity = {3, 0, 0};
    run(rigid, 1e-3, 1000);
    const Body& ball = rigid.bodies[0];
    EXPECT_NEAR(ball.velocity.x(), 15.0 / 7, 1e-6 * 15 / 7);
    EXPECT_NEAR(ball.position.x(), 2.330088, 1e-5);
    EXPECT_NEAR(ball.velocity.x() - 0.1 * angular_velocity(ball).y(), 0, 1e-9);
}

} // namespace
} // namespace hyoryu::test_slide
