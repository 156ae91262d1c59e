// SPDX-License-Identifier: MIT
// Bodies against each other: the ledger of momentum, boxes in mid-air, invariance, restart.
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hyoryu::test_bodies {
namespace {

using namespace test;

double number(int k)
{
    const double x = std::sin(12.9898 * k + 78.233) * 43758.5453;
    return x - std::floor(x);
}

Body thrown(Body body, const Vec3& velocity, const Vec3& omega)
{
    body.velocity = velocity;
    body.angular_momentum = angular_momentum(body, omega);
    return body;
}

// Debris of all shapes in a basin, with an obstacle.
Rigid jumble(int n)
{
    Rigid rigid = scene(0.4, 0.3);
    Basin basin{{-1, -1, 0}, {1, 1, 9}}; // higher than anything flies
    basin.open[5] = true;
    rigid.boundaries.push_back({"tank", basin});
    rigid.boundaries.push_back({"house", Obstacle{box_polytope({0.3, 0.3, 0.4}, 3), {0, 0, 0.2}}});
    for (int k = 0; k < n; ++k) {
        const auto r = [k](int m) { return number(31 * k + m) - 0.5; };
        ContactShape shape = box_polytope({0.5, 0.1, 0.1}, 3);
        if (k % 3 == 1) {
            shape = Ball{0.1};
        } else if (k % 3 == 2) {
            shape = Rod{0.06, 0.5};
        }
        Body body =
            body_of(shape, k % 2 == 0 ? 500 : 2500, {0.9 * r(0), 0.9 * r(1), 0.8 + 0.3 * k});
        body.orientation = Quat(r(2), r(3), r(4), r(5)).normalized();
        rigid.bodies.push_back(
            thrown(body, 4 * Vec3(r(6), r(7), r(8)), 10 * Vec3(r(9), r(10), r(11))));
    }
    return rigid;
}

TEST(Ledger, MomentumOfEveryBodyClosesFromTheLog)
{
    Rigid rigid = jumble(8);
    double worst = 0;
    double most_turn = 0;
    for (int k = 0; k < 1500; ++k) {
        std::vector<Wrench> loads(rigid.bodies.size());
        for (std::size_t m = 0; m < loads.size(); ++m) {
            const int base = static_cast<int>(m) + 100 * k;
            loads[m].force =
                10 * Vec3(number(base) - 0.5, number(base + 7) - 0.5, number(base + 13));
        }
        const std::vector<Body> before = rigid.bodies;
        std::vector<Contact> log;
        const double dt = 1e-3;
        step(rigid, k * dt, dt, loads, log);
        for (std::size_t m = 0; m < before.size(); ++m) {
            const Body& now = rigid.bodies[m];
            Vec3 sum = dt * (now.mass.mass * rigid.settings.gravity + loads[m].force);
            Vec3 moment = Vec3::Zero();
            for (const Contact& contact : log) {
                const Vec3 P = contact.normal_impulse * contact.normal + contact.tangential_impulse;
                const double sign = contact.a == static_cast<int>(m)   ? 1
                                    : contact.b == static_cast<int>(m) ? -1
                                                                       : 0;
                sum += sign * P;
                moment +=
                    sign * (contact.point - 0.5 * (before[m].position + now.position)).cross(P);
                EXPECT_GE(contact.energy_lost, 0);
            }
            const Vec3 gained = now.mass.mass * (now.velocity - before[m].velocity);
            worst = std::max(worst,
                             (gained - sum).norm() / (now.mass.mass * (0.1 + now.velocity.norm())));
            most_turn = std::max(
                most_turn, (now.angular_momentum - before[m].angular_momentum - moment).norm());
        }
    }
    EXPECT_LE(worst, 1e-12);
    EXPECT_LE(rigid.counters.worst_penetration, 1e-3);
    for (std::size_t a = 0; a < rigid.bodies.size(); ++a) {
        for (std::size_t b = a + 1; b < rigid.bodies.size(); ++b) {
            EXPECT_LE(overlap(rigid, static_cast<int>(a), static_cast<int>(b), 1.5), 1e-4);
        }
    }
}

TEST(MidAir, CornerOnFaceKeepsMomentumAndLosesEnergy)
{
    // one box flat, the other comes corner first; then edge against edge
    const Quat corner_first = Quat::FromTwoVectors(Vec3(1, 1, 1).normalized(), -Vec3::UnitX());
    const Quat edge_first = turn_about(Vec3::UnitX(), 40) * turn_about(Vec3::UnitY(), 45);
    for (const auto& [left, right] :
         {std::pair(Quat::Identity(), corner_first), {turn_about(Vec3::UnitZ(), 45), edge_first}}) {
        Rigid rigid = scene(0.6, 0.3);
        rigid.settings.gravity.setZero();
        rigid.bodies.push_back(
            thrown(box({0.2, 0.2, 0.2}, 500, {-0.5, 0.02, 0.01}), {2, 0, 0}, Vec3::Zero()));
        rigid.bodies.push_back(
            thrown(box({0.2, 0.2, 0.2}, 900, {0.5, 0, 0}), {-3, 0, 0}, Vec3::Zero()));
        rigid.bodies[0].orientation = left;
        rigid.bodies[1].orientation = right;
        const auto momentum = [&] {
            Vec3 p = Vec3::Zero();
            Vec3 L = Vec3::Zero();
            for (const Body& body : rigid.bodies) {
                p += body.mass.mass * body.velocity;
                L += body.angular_momentum + body.mass.mass * body.position.cross(body.velocity);
            }
            return std::pair(p, L);
        };
        const auto before = momentum();
        const double E = energy(rigid);
        const std::vector<Contact> log = run(rigid, 1e-3, 300);
        ASSERT_EQ(log.size(), 1U);
        const auto after = momentum();
        EXPECT_LE((after.first - before.first).norm(), 1e-12 * 50);
        EXPECT_LE((after.second - before.second).norm(), 1e-10);
        EXPECT_NEAR(E - energy(rigid), log[0].energy_lost, 1e-11 * E);
        EXPECT_LE(rigid.counters.worst_penetration, 2e-11);
    }
}

TEST(MidAir, DiscsAndRectanglesInThePlane)
{
    Rigid rigid = scene(0.6, 0.3, 2);
    rigid.settings.gravity.setZero();
    rigid.bodies.push_back(box({0.2, 0, 0.2}, 500, {-0.5, 0, 0.05}, 2));
    rigid.bodies.push_back(body_of(Ball{0.1}, 900, {0.5, 0, 0}, 2));
    rigid.bodies[0].velocity = {2, 0, 0};
    rigid.bodies[1].velocity = {-3, 0, 0};
    const double E = energy(rigid);
    const std::vector<Contact> log = run(rigid, 1e-3, 300);
    ASSERT_EQ(log.size(), 1U);
    EXPECT_NEAR(log[0].time, 0.16, 1e-9); // a gap of 0.8 m at 5 m/s
    EXPECT_NEAR(E - energy(rigid), log[0].energy_lost, 1e-11 * E);
    EXPECT_EQ(rigid.bodies[1].position.y(), 0);
}

TEST(Invariance, TurnedWorldGivesTheSameMotion)
{
    const Quat turn = Quat(0.3, -0.5, 0.7, 0.2).normalized();
    Rigid plain = on_floor(0.4, 0.3);
    plain.bodies.push_back(box(timber_size(), 520, {0, 0, 0.5}));
    plain.bodies[0].orientation = turn_about(Vec3::UnitY(), 45) * turn_about(Vec3::UnitX(), 10);
    Rigid turned = on_floor(0.4, 0.3);
    turned.settings.gravity = turn * turned.settings.gravity;
    turned.boundaries[0].surface = Plane{Vec3::Zero(), turn * Vec3::UnitZ()};
    turned.bodies.push_back(plain.bodies[0]);
    turned.bodies[0].position = turn * plain.bodies[0].position;
    turned.bodies[0].orientation = turn * plain.bodies[0].orientation;
    run(plain, 1e-3, 500);
    run(turned, 1e-3, 500);
    EXPECT_LE((turned.bodies[0].position - turn * plain.bodies[0].position).norm(), 1e-9);
}

TEST(Invariance, OrderOfBodiesDoesNotMatter)
{
    Rigid one = jumble(4);
    Rigid other = jumble(4);
    std::reverse(other.bodies.begin(), other.bodies.end());
    run(one, 1e-3, 500);
    run(other, 1e-3, 500);
    double worst = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        worst = std::max(worst, (one.bodies[k].position - other.bodies[3 - k].position).norm());
    }
    EXPECT_LE(worst, 1e-9);
}

TEST(Restart, ContinuesWithTheSameBits)
{
    Rigid whole = jumble(6);
    run(whole, 1e-3, 900);
    Rigid second = jumble(6);
    second.bodies = whole.bodies;
    set_contact_start(second, contact_start(whole));
    run(whole, 1e-3, 200, {}, 0.9);
    run(second, 1e-3, 200, {}, 0.9);
    for (std::size_t k = 0; k < whole.bodies.size(); ++k) {
        EXPECT_EQ(whole.bodies[k].position, second.bodies[k].position);
        EXPECT_EQ(whole.bodies[k].orientation.coeffs(), second.bodies[k].orientation.coeffs());
        EXPECT_EQ(whole.bodies[k].velocity, second.bodies[k].velocity);
        EXPECT_EQ(whole.bodies[k].angular_momentum, second.bodies[k].angular_momentum);
    }
}

TEST(Locks, LockedAxesDoNotMove)
{
    Rigid rigid = jumble(6);
    for (Body& body : rigid.bodies) {
        body.locks = {false, true, false, true, false, true};
        body.orientation = turn_about(Vec3::UnitY(), 30);
        body.velocity.y() = 0;
        body.angular_momentum = {0, body.angular_momentum.y(), 0};
    }
    rigid.bodies[0].locks.fill(true);
    const std::vector<Body> start = rigid.bodies;
    run(rigid, 1e-3, 1000);
    EXPECT_EQ(rigid.bodies[0].position, start[0].position);
    for (std::size_t k = 0; k < start.size(); ++k) {
        EXPECT_EQ(rigid.bodies[k].position.y(), start[k].position.y());
        EXPECT_TRUE(rigid.bodies[k].position.allFinite());
    }
}

TEST(Overlap, InitialOverlapLeavesWithoutEnergy)
{
    Rigid rigid = on_floor(0.4, 0.3);
    rigid.settings.gravity.setZero();
    rigid.bodies.push_back(box(Vec3::Constant(0.2), 500, {0, 0, 0.1 - 1e-4}));
    rigid.bodies.push_back(box(Vec3::Constant(0.2), 500, {0.05, 0, 0.3 - 4e-4}));
    run(rigid, 1e-3, 200);
    EXPECT_LE(overlap(rigid, 0, 1, 0.2), 1e-5);
    EXPECT_LE(overlap(rigid, 0, -1, 0.2), 1e-5);
    EXPECT_LE(energy(rigid), 1e-12);
}

TEST(Painleve, SlidingRodTerminates)
{
    // the timber at 57.7 degrees pushed into its contact, with more friction than any solution
    // allows
    Rigid rigid = on_floor(0.0, 1.5);
    rigid.bodies.push_back(box(timber_size(), 520, Vec3::Zero()));
    Body& body = rigid.bodies[0];
    body.orientation = turn_about(Vec3::UnitY(), 57.72);
    const Vec3 corner = body.orientation * Vec3(0.5, 0, -0.05);
    body.position = -corner;
    body.velocity = {2, 0, -0.01};
    const double E = energy(rigid);
    run(rigid, 1e-3, 300);
    EXPECT_TRUE(body.position.allFinite());
    EXPECT_LE(energy(rigid), E * (1 + 1e-12));
    EXPECT_GT(rigid.counters.tangential_impacts, 0);
}

} // namespace
} // namespace hyoryu::test_bodies
