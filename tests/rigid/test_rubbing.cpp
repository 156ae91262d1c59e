// SPDX-License-Identifier: MIT
// Friction of flat patches: turning on the spot against the integral of the pressure over the face.
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hyoryu {
namespace {

using namespace test;

// The mean distance from the centre of a rectangle, by the midpoint rule.
double mean_distance(double a, double b)
{
    constexpr int n = 400;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            sum += std::hypot(((i + 0.5) / n - 0.5) * a, ((j + 0.5) / n - 0.5) * b);
        }
    }
    return sum / (n * n);
}

// The time after which a body that turns on the floor about its upright axis stands still.
double time_to_stop(const Body& start, double mu, double dt)
{
    Rigid rigid = on_floor(0, mu);
    rigid.bodies.push_back(start);
    for (int k = 0; k < 100000; ++k) {
        const double before = angular_velocity(rigid.bodies[0]).z();
        run(rigid, dt, 1, {}, dt * k);
        const double after = angular_velocity(rigid.bodies[0]).z();
        if (after < 1e-6 * before || after < 1e-9) {
            return dt * k;
        }
    }
    return infinity;
}

TEST(Rubbing, ABoxThatTurnsFlatStopsWhenUniformPressureSays)
{
    std::mt19937 numbers(7);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int k = 0; k < 12; ++k) {
        const Vec3 size(0.05 + unit(numbers), 0.05 + unit(numbers), 0.05 + 0.5 * unit(numbers));
        const double mu = 0.1 + 0.5 * unit(numbers);
        const double spin = 2 + 8 * unit(numbers);
        const double dt = k % 2 == 0 ? 1e-3 : 4e-3;
        Body body = box(size, 500, {0, 0, size.z() / 2});
        body.orientation = turn_about(Vec3::UnitZ(), 360 * unit(numbers));
        body.angular_momentum = angular_momentum(body, {0, 0, spin});
        const double moment = mu * body.mass.mass * g * mean_distance(size.x(), size.y());
        const double expected = body.mass.inertia(2, 2) * spin / moment;
        // the step in which it stops, and the midpoint rule
        EXPECT_NEAR(time_to_stop(body, mu, dt), expected, 1.01 * dt + 1e-4 * expected)
            << size.transpose();
    }
}

TEST(Rubbing, ACylinderThatTurnsOnItsEndStopsAsADisc)
{
    for (const double radius : {0.05, 0.3}) {
        for (const double dt : {1e-3, 4e-3}) {
            Body body = body_of(Rod{radius, 0.2}, 500, {0, 0, 0.1});
            body.orientation = turn_about(Vec3::UnitY(), 90);
            body.angular_momentum = angular_momentum(body, {0, 0, 5});
            const double expected = 3 * radius * 5 / (4 * 0.3 * g);
            EXPECT_NEAR(time_to_stop(body, 0.3, dt), expected, 1.01 * dt) << radius;
        }
    }
}

} // namespace
} // namespace hyoryu
