// SPDX-License-Identifier: MIT
// Friction of flat patches: turning on the spot against the integral of the pressure over the face.
#include "dice.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hyoryu::test_rubbing {
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

Vec3 direction(Dice& dice)
{
    const double z = dice.between(-1, 1);
    const double angle = dice.between(0, 6.283185307179586);
    return {std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z};
}

// A crate on a plate that loads press together along their normal, without a moment on the pair,
// which tumbles in free space like one body.
struct TumblingPair {
    Rigid rigid = scene(0, 0.8);
    std::vector<Wrench> loads;
};

TumblingPair tumbling_pair(Dice& dice)
{
    TumblingPair pair;
    pair.rigid.settings.gravity = Vec3::Zero();
    const double angle = dice.between(0, 3);
    const Quat turn(Eigen::AngleAxisd(angle, direction(dice)));
    const Vec3 n = turn * Vec3::UnitZ();
    Body plate = box({0.6, 0.5, 0.1}, 700, turn * Vec3(0, 0, -0.05));
    const Vec3 size{dice.between(0.15, 0.25), dice.between(0.15, 0.25), 0.2};
    const Vec3 place{dice.between(-0.1, 0.1), dice.between(-0.1, 0.1), 0.1};
    Body crate = box(size, 500, turn * place);
    plate.orientation = turn;
    crate.orientation = turn * turn_about(Vec3::UnitZ(), dice.between(0, 90));
    const Vec3 force = 3000 * n;
    const Vec3 arm = crate.position - plate.position;
    pair.loads = {{force, arm.cross(force)}, {-force, Vec3::Zero()}};
    const Vec3 centre = (plate.mass.mass * plate.position + crate.mass.mass * crate.position) /
                        (plate.mass.mass + crate.mass.mass);
    const Vec3 spin = dice.between(1, 3) * direction(dice);
    for (Body* body : {&plate, &crate}) {
        body->velocity = spin.cross(body->position - centre);
        body->angular_momentum = angular_momentum(*body, spin);
    }
    pair.rigid.bodies = {plate, crate};
    if (dice.between(0, 1) < 0.5) {
        std::swap(pair.rigid.bodies[0], pair.rigid.bodies[1]);
        std::swap(pair.loads[0], pair.loads[1]);
    }
    return pair;
}

TEST(Rubbing, APatchThatSticksRubsAtTheSamePlacesOfAPairThatTumbles)
{
    for (int seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(seed);
        const double dt = seed % 2 == 0 ? 1e-3 : 2e-3;
        TumblingPair pair = tumbling_pair(dice);
        std::vector<Contact> log;
        step(pair.rigid, 0, dt, pair.loads, log);
        const ContactStart first = contact_start(pair.rigid);
        step(pair.rigid, dt, dt, pair.loads, log);
        const ContactStart second = contact_start(pair.rigid);
        const std::size_t contacts = first.stuck.size();
        ASSERT_GE(contacts, 4u);
        ASSERT_EQ(first.stuck, std::vector<int>(contacts, static_cast<int>(contacts)));
        ASSERT_EQ(second.features, first.features);
        ASSERT_EQ(second.stuck, first.stuck);
        for (std::size_t k = 0; k < contacts; ++k) {
            EXPECT_GT(first.rubs[k].norm(), 0.01);
            // the round-off of a few products of rotations
            EXPECT_LT((second.rubs[k] - first.rubs[k]).norm(), 1e-14) << k;
        }
    }
}

} // namespace
} // namespace hyoryu::test_rubbing
