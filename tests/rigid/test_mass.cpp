// SPDX-License-Identifier: MIT
// Mass properties against closed forms, and free rotation (contact notes, scene (j); test T15).
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hyoryu::test_mass {
namespace {

using namespace test;

constexpr double pi = 3.14159265358979323846;

void expect_inertia(const MassProperties& mass, double m, const Vec3& diagonal)
{
    EXPECT_NEAR(mass.mass, m, 1e-13 * m);
    const Mat3 expected = diagonal.asDiagonal();
    EXPECT_LE((mass.inertia - expected).norm(), 1e-13 * diagonal.norm());
}

TEST(Mass, BoxAndTimber)
{
    const double m = 0.045;
    expect_inertia(mass_properties(box_polytope(cube_size(), 3), 250, 3), m,
                   m / 12 * Vec3(0.0036 + 0.0025, 0.0036 + 0.0025, 0.0072));
    const MassProperties timber = mass_properties(box_polytope(timber_size(), 3), 520, 3);
    EXPECT_NEAR(timber.mass, 5.2, 1e-12);
    EXPECT_NEAR(timber.inertia(1, 1), 0.437667, 5e-7); // contact notes, (c)
}

TEST(Mass, BallAndRod)
{
    const double ball = 1000 * 4.0 / 3 * pi * 0.008;
    expect_inertia(mass_properties(Ball{0.2}, 1000, 3), ball, Vec3::Constant(0.4 * ball * 0.04));
    const double rod = 1000 * pi * 0.01 * 2;
    const double across = rod * (3 * 0.01 + 4) / 12;
    expect_inertia(mass_properties(Rod{0.1, 2}, 1000, 3), rod, {rod * 0.01 / 2, across, across});
}

TEST(Mass, TetrahedronAwayFromItsCentre)
{
    // corner tetrahedron of edge 1: mass rho/6, inertia about its centre 3/80 m on the diagonal,
    // products m/80
    Polytope tetrahedron{{{5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {5, 0, 1}},
                         {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
    const MassProperties mass = mass_properties(tetrahedron, 6, 3);
    EXPECT_NEAR(mass.mass, 1, 1e-12);
    Mat3 expected = Mat3::Constant(1.0 / 80);
    expected.diagonal().setConstant(6.0 / 80);
    EXPECT_LE((mass.inertia - expected).norm(), 1e-12);
}

TEST(Mass, TwoDimensions)
{
    const MassProperties rectangle = mass_properties(box_polytope({2, 9, 1}, 2), 3, 2);
    EXPECT_NEAR(rectangle.mass, 6, 1e-13);
    EXPECT_NEAR(rectangle.inertia(1, 1), 6 * 5.0 / 12, 1e-13);
    const MassProperties disc = mass_properties(Ball{0.5}, 2, 2);
    EXPECT_NEAR(disc.mass, 2 * pi * 0.25, 1e-13);
    EXPECT_NEAR(disc.inertia(1, 1), disc.mass * 0.125, 1e-13);
    const MassProperties plank = mass_properties(Rod{0.5, 2}, 3, 2);
    EXPECT_NEAR(plank.inertia(1, 1), rectangle.inertia(1, 1), 1e-13);
}

// Box 0.30 x 0.20 x 0.05 m of 3 kg spun about its middle axis.
class Spin : public testing::TestWithParam<double> {};

TEST_P(Spin, FlipsTenTimesInTwentySeconds)
{
    const double dt = GetParam();
    Rigid rigid = scene(0, 0);
    rigid.settings.gravity.setZero();
    rigid.bodies.push_back(box({0.30, 0.20, 0.05}, 1000, Vec3::Zero()));
    Body& body = rigid.bodies[0];
    body.angular_momentum = angular_momentum(body, {0.1, 10, 0});
    const Vec3 L = body.angular_momentum;
    const double E = kinetic_energy(body);
    EXPECT_NEAR(E, 1.156303125, 1e-12);
    int flips = 0;
    double previous = 10;
    double last = 0;
    const int steps = static_cast<int>(std::lround(20 / dt));
    run(rigid, dt, steps, [&](double t) {
        const double spin = (body.orientation.conjugate() * angular_velocity(body)).y();
        if (spin * previous < 0) {
            ++flips;
            last = t - dt * spin / (spin - previous);
        }
        previous = spin;
    });
    EXPECT_EQ(flips, 10);
    EXPECT_NEAR(last, 1.022490 + 9 * 2.044981, 2 * dt * dt + 2e-5);
    EXPECT_LE(std::abs(kinetic_energy(body) / E - 1), 1e-7);
    EXPECT_EQ(body.angular_momentum, L);
}

INSTANTIATE_TEST_SUITE_P(Steps, Spin, testing::Values(1e-2, 1e-3, 1e-4));

} // namespace
} // namespace hyoryu::test_mass
