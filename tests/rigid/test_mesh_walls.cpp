// SPDX-License-Identifier: MIT
// Triangle surfaces as walls: equal to planes and boxes where they are the same surface, no ghost
// hits at inner edges, no body through a thin sheet.
#include "scenes.hpp"
#include "surfaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hyoryu::test_mesh_walls {
namespace {

using namespace test;

Rigid on_mesh(MeshSurface mesh, double restitution, double friction)
{
    Rigid rigid = scene(restitution, friction);
    rigid.boundaries.push_back({"ground", std::move(mesh)});
    return rigid;
}

double distance_of(const Body& a, const Body& b)
{
    return (a.position - b.position).norm() +
           (a.orientation.toRotationMatrix() - b.orientation.toRotationMatrix()).norm();
}

// The largest difference of one body on two grounds over a run.
double difference(Rigid one, Rigid other, const Body& body, double dt, int steps)
{
    one.bodies.push_back(body);
    other.bodies.push_back(body);
    double worst = 0;
    for (int k = 0; k < steps; ++k) {
        run(one, dt, 1, {}, k * dt);
        run(other, dt, 1, {}, k * dt);
        worst = std::max(worst, distance_of(one.bodies[0], other.bodies[0]));
    }
    return worst;
}

TEST(MeshFloor, SlidingBoxMeetsNoInnerEdge)
{
    for (const double heading : {0.0, 30.0, 45.0}) {
        Body body = box(cube_size(), 250, {0, 0, 0.025});
        body.orientation = turn_about(Vec3::UnitZ(), heading);
        body.velocity = body.orientation * Vec3(1, 0, 0);
        // the same contacts on the same plane: only the order of sums differs
        EXPECT_LE(
            difference(on_mesh(flat_floor(1, 40), 0.3, 0.2), on_floor(0.3, 0.2), body, 1e-3, 600),
            1e-9)
            << heading;
    }
}

TEST(MeshFloor, SkiddingBallAndRollingRod)
{
    Body ball = body_of(Ball{0.1}, 500, {-0.9, 0.05, 0.1});
    ball.velocity = {1.5, 0.3, 0};
    EXPECT_LE(
        difference(on_mesh(flat_floor(1.2, 40), 0.3, 0.2), on_floor(0.3, 0.2), ball, 1e-3, 1000),
        1e-9);
    Body rod = body_of(Rod{0.05, 0.5}, 500, {-0.8, 0, 0.05});
    rod.orientation = turn_about(Vec3::UnitZ(), 80);
    rod.velocity = rod.orientation * Vec3(0, -1.2, 0);
    EXPECT_LE(
        difference(on_mesh(flat_floor(1.2, 40), 0.3, 0.2), on_floor(0.3, 0.2), rod, 1e-3, 1000),
        1e-9);
}

TEST(MeshFloor, TumblingBoxBouncesAsOnAPlane)
{
    Body body = box(cube_size(), 250, {0, 0, 0.15});
    body.orientation = turn_about(Vec3::UnitX(), 20) * turn_about(Vec3::UnitY(), 30);
    // three impacts; after more of them round-off of the first grows beyond any tolerance
    EXPECT_LE(
        difference(on_mesh(flat_floor(1, 40), 0.75, 0.3), on_floor(0.75, 0.3), body, 1e-3, 350),
        1e-9);
}

TEST(MeshBlock, IsTheSameWallAsTheBox)
{
    // onto the edge of a block, sliding over its rim, and against its side
    const Polytope block = box_polytope({1, 1, 0.4}, 3);
    const auto place = [](const Vec3& at, const Vec3& velocity, double tilt) {
        Body body = box({0.3, 0.2, 0.1}, 600, at);
        body.orientation = turn_about(Vec3(1, 2, 0.5).normalized(), tilt);
        body.velocity = velocity;
        return body;
    };
    for (const Body& body :
         {place({0.45, 0.1, 0.5}, {0, 0, 0}, 25), place({0.35, 0, 0.25}, {1, 0.2, 0}, 0),
          place({0.9, 0.1, 0.05}, {-2, 0, 0.2}, 40)}) {
        Rigid wall = scene(0.4, 0.3);
        wall.boundaries.push_back({"block", Obstacle{block}});
        // corners and edges are found in another way: the same points to rounding
        EXPECT_LE(difference(on_mesh(surface_of(block, Vec3::Zero()), 0.4, 0.3), std::move(wall),
                             body, 1e-3, 250),
                  1e-7)
            << body.position.transpose();
    }
}

TEST(MeshSheet, NothingPassesThroughAThinTriangle)
{
    for (const double speed : {30.0, 100.0}) {
        for (const double x : {0.0, 0.31, -0.22}) {
            Rigid rigid = on_mesh({{{-2, -1, 0}, {2, -1, 0}, {0, 2, 0}}, {{0, 1, 2}}}, 0.4, 0.3);
            Body rod = box({1, 0.02, 0.02}, 500, {x, 0.05, 1.3});
            rod.orientation = turn_about(Vec3::UnitY(), 60);
            rod.velocity = {0, 0, -speed};
            rigid.bodies.push_back(rod);
            double lowest = 1;
            run(rigid, 1.0 / 60, 30, [&](double) {
                for (const Vec3& corner : box_polytope({1, 0.02, 0.02}, 3).corners) {
                    const Vec3 p = rigid.bodies[0].position + rigid.bodies[0].orientation * corner;
                    lowest = std::min(lowest, p.z() + (p.head<2>().norm() > 0.8 ? 1 : 0));
                }
            });
            EXPECT_GE(lowest, -1e-6) << speed; // -1e-3 mm
            EXPECT_GE(rigid.counters.impacts, 1);
            EXPECT_LE(rigid.counters.worst_penetration, 1e-6);
        }
    }
}

TEST(MeshSpike, CarriesABoxOnItsTip)
{
    Rigid rigid = on_mesh(spike(0.2, 0.3), 0.5, 0.3);
    rigid.bodies.push_back(box({0.4, 0.4, 0.1}, 500, {0, 0, 0.45}));
    const std::vector<Contact> log = run(rigid, 1e-3, 250);
    // 0.1 m of fall onto the middle of the face: v+ = -e v, and no spin
    const double v = std::sqrt(2 * g * 0.1);
    ASSERT_FALSE(log.empty());
    EXPECT_NEAR(log[0].approach_speed, v, 1e-9);
    EXPECT_NEAR(log[0].time, v / g, 1e-9);
    EXPECT_LE((log[0].point - Vec3(0, 0, 0.3)).norm(), 1e-9);
    EXPECT_LE((log[0].normal - Vec3::UnitZ()).norm(), 1e-12);
    EXPECT_LE(rigid.bodies[0].angular_momentum.norm(), 1e-12);
    EXPECT_NEAR(rigid.bodies[0].velocity.z(), 0.5 * v - g * (0.25 - v / g), 1e-9);
}

TEST(MeshSpike, StopsABallAndARod)
{
    for (const ContactShape& shape : {ContactShape(Ball{0.1}), ContactShape(Rod{0.1, 0.6})}) {
        Rigid rigid = on_mesh(spike(0.2, 0.3), 0.5, 0.3);
        rigid.bodies.push_back(body_of(shape, 500, {0, 0, 0.5}));
        const std::vector<Contact> log = run(rigid, 1e-3, 200);
        ASSERT_FALSE(log.empty());
        EXPECT_NEAR(log[0].approach_speed, std::sqrt(2 * g * 0.1), 1e-9);
        EXPECT_LE((log[0].point - Vec3(0, 0, 0.3)).norm(), 1e-8);
        EXPECT_LE((log[0].normal - Vec3::UnitZ()).norm(), 1e-6);
    }
}

TEST(MeshBasin, HoldsABoxInItsCorner)
{
    // the inside of a box: all edges look inwards and have no contact of their own
    MeshSurface tank = surface_of(box_polytope({1, 1, 1}, 3), {0, 0, 0.5});
    for (auto& t : tank.triangles) {
        std::swap(t[1], t[2]);
    }
    Rigid rigid = on_mesh(tank, 0.3, 0.2);
    rigid.bodies.push_back(box(Vec3::Constant(0.2), 500, {0.1, 0.2, 0.1}));
    rigid.bodies[0].velocity = {1.5, 1.1, 0};
    Rigid basin = scene(0.3, 0.2);
    basin.boundaries.push_back({"basin", Basin{{-0.5, -0.5, 0}, {0.5, 0.5, 1}, {}}});
    basin.bodies = rigid.bodies;
    run(rigid, 1e-3, 1000);
    run(basin, 1e-3, 1000);
    EXPECT_LE(distance_of(rigid.bodies[0], basin.bodies[0]), 1e-8);
    EXPECT_LE(rigid.counters.worst_penetration, 1e-6);
}

TEST(MeshOverlap, IsToldForPlans)
{
    Rigid rigid = on_mesh(surface_of(box_polytope({1, 1, 0.4}, 3), Vec3::Zero()), 0.3, 0.2);
    rigid.bodies.push_back(box(Vec3::Constant(0.2), 500, {0, 0, 0.3 - 1e-3}));
    EXPECT_NEAR(overlap(rigid, 0, -1, 0), 1e-3, 1e-12);
    rigid.bodies[0].position.z() = 0.4;
    EXPECT_LE(overlap(rigid, 0, -1, 0), 0);
}

} // namespace
} // namespace hyoryu::test_mesh_walls
