// SPDX-License-Identifier: MIT
// Walls that move: restitution on the relative speed at the instant, and the momentum they give.
#include "scenes.hpp"
#include "surfaces.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hyoryu::test_moving_walls {
namespace {

using namespace test;

Motion path()
{
    return {Vec3::Zero(), {0, 0.2, 0.5, 1.0}, {{0, 0, 0}, {0.1, 0, 0}, {0.5, 0, 0}, {0.6, 0, 0}}};
}

TEST(Piston, BouncesABodyByTheSpeedItHasAtTheInstant)
{
    const MeshSurface sheet{{{0, -1, -1}, {0, 1, -1}, {0, 0, 2}}, {{0, 1, 2}}};
    const Polytope block = box_polytope({0.2, 2, 2}, 3);
    for (const auto& surface : {decltype(Boundary::surface)(Plane{Vec3::Zero(), Vec3::UnitX()}),
                                decltype(Boundary::surface)(Obstacle{block, {-0.1, 0, 0}}),
                                decltype(Boundary::surface)(sheet)}) {
        Rigid rigid = scene(0.6, 0.3);
        rigid.settings.gravity.setZero();
        rigid.boundaries.push_back({"piston", surface, 0, path()});
        rigid.bodies.push_back(box(Vec3::Constant(0.1), 500, {0.35, 0, 0}));
        rigid.bodies[0].velocity = {-0.3, 0, 0};
        const std::vector<Contact> log = run(rigid, 0.01, 35);
        ASSERT_FALSE(log.empty());
        const double t = log[0].time;
        // the face at 0.3 - 0.3 t meets the piston
        EXPECT_NEAR(displacement(path(), t).x(), 0.3 - 0.3 * t, 1e-10);
        const double w = velocity(path(), t).x();
        EXPECT_NEAR(log[0].approach_speed, 0.3 + w, 1e-9);
        double P = 0;
        for (const Contact& c : log) {
            P += c.normal_impulse * c.normal.x();
        }
        const Body& body = rigid.bodies[0];
        EXPECT_NEAR(body.velocity.x(), w + 0.6 * (0.3 + w), 1e-9);
        EXPECT_NEAR(body.mass.mass * (body.velocity.x() + 0.3), P, 1e-12);
    }
}

TEST(Gate, ClosesOntoABoxAndHoldsIt)
{
    Rigid rigid = on_floor(0.0, 0.4);
    rigid.boundaries.push_back({"gate",
                                Obstacle{box_polytope({0.1, 1, 0.2}, 3), {0, 0, 0.42}},
                                0,
                                {Vec3::Zero(), {0, 0.5}, {{0, 0, 0}, {0, 0, -0.12}}}});
    rigid.bodies.push_back(box(Vec3::Constant(0.2), 500, {0.04, 0, 0.1}));
    // the gate comes down to the top of the box, 0.2, and stops there
    std::vector<Contact> log = run(rigid, 1e-3, 1000);
    EXPECT_LE(rigid.counters.worst_penetration, 1e-6);
    EXPECT_LE(rigid.bodies[0].velocity.norm(), 1e-3);
    EXPECT_LE((rigid.bodies[0].position - Vec3(0.04, 0, 0.1)).norm(), 1e-6);
}

TEST(MovingBox, CarriesASphereInside)
{
    // gravity holds the sphere on the floor; the rear wall hits it and drives it on
    Rigid rigid = scene(0.5, 0.0);
    Boundary tank{"tank", Basin{{-1, -1, 0}, {1, 1, 1}, {}}};
    tank.motion.velocity = {1.5, 0, 0};
    rigid.boundaries.push_back(tank);
    rigid.bodies.push_back(body_of(Ball{0.1}, 500, {0, 0, 0.1}));
    const std::vector<Contact> log = run(rigid, 1e-3, 1500);
    double P = 0;
    for (const Contact& c : log) {
        P += c.normal_impulse * c.normal.x();
    }
    // first hit at 0.9/1.5 s: u+ = w + e w; then the front wall is 1.8 away at 0.75 m/s
    const Body& ball = rigid.bodies[0];
    EXPECT_NEAR(ball.velocity.x(), 1.5 * 1.5, 1e-9);
    EXPECT_NEAR(ball.position.x(), 2.25 * (1.5 - 0.6), 1e-9);
    EXPECT_NEAR(P, ball.mass.mass * ball.velocity.x(), 1e-12);
}

TEST(Corner, SlidingIntoATankCornerKeepsAxesApart)
{
    // a flush hit of two walls: v+ = -e v for each, no spin
    Rigid rigid = scene(0.5, 0.0);
    rigid.boundaries.push_back({"tank", Basin{{-1, -1, 0}, {1, 1, 1}, {}}});
    rigid.bodies.push_back(box(Vec3::Constant(0.2), 500, {0.4, 0.4, 0.1}));
    rigid.bodies[0].velocity = {1, 1, 0};
    run(rigid, 1e-3, 600);
    EXPECT_LE((rigid.bodies[0].velocity - Vec3(-0.5, -0.5, 0)).norm(), 1e-9);
    EXPECT_LE(rigid.bodies[0].angular_momentum.norm(), 1e-9);
}

} // namespace
} // namespace hyoryu::test_moving_walls
