// SPDX-License-Identifier: MIT
// Cylinders on boxes, cylinders and meshes: motion against closed forms and against the same motion
// on a plane.
#include "scenes.hpp"
#include "surfaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyoryu::test_rods {
namespace {

using namespace test;

constexpr double quarter = 90; // [degrees]

Boundary block(const Vec3& size, const Vec3& top, const Quat& turn = Quat::Identity())
{
    return {"block", Obstacle{box_polytope(size, 3), top - Vec3(0, 0, size.z() / 2), turn}};
}

// What rolls at 1 m/s towards `heading` degrees from x, its axis across.
Body rolling(const Rod& rod, double heading, const Vec3& position)
{
    Body body = body_of(rod, 700, position);
    body.orientation = turn_about(Vec3::UnitZ(), heading + quarter);
    const Vec3 ahead = turn_about(Vec3::UnitZ(), heading) * Vec3::UnitX();
    body.velocity = ahead;
    body.angular_momentum = angular_momentum(body, Vec3::UnitZ().cross(ahead) / rod.radius);
    return body;
}

TEST(RodRolls, OnABoxAtOneHeightAndSpeed)
{
    // within the top, with both ends past it, and along a diagonal
    for (const auto& [length, heading] :
         {std::pair(0.4, 0.0), {1.4, 0.0}, {0.4, 30.0}, {1.4, 10.0}}) {
        Rigid rigid = scene(0.3, 0.4);
        rigid.boundaries.push_back(block({3, 1, 0.4}, {0, 0, 0}));
        const Rod rod{0.08, length};
        rigid.bodies.push_back(rolling(rod, heading, {-0.3, 0, rod.radius}));
        const double before = energy(rigid);
        double last = before;
        run(rigid, 1e-3, 500, [&](double) {
            EXPECT_NEAR(rigid.bodies[0].position.z(), rod.radius, 1e-9);
            // round-off of a step
            EXPECT_NEAR(energy(rigid), last, 1e-12 * before) << length << " " << heading;
            last = energy(rigid);
        });
        const Vec3 way(std::cos(heading * std::numbers::pi / 180),
                       std::sin(heading * std::numbers::pi / 180), 0);
        EXPECT_LE((rigid.bodies[0].position - Vec3(-0.3, 0, rod.radius) - 0.5 * way).norm(), 1e-9);
        EXPECT_LE(rigid.counters.impacts, 0);
    }
}

TEST(RodRolls, OffAFixedRod)
{
    // Without slip: 3/4 v^2 = g (R + r) (1 - cos theta) from rest at the top.
    const Rod large{0.3, 1};
    const Rod small{0.1, 0.6};
    const double s = large.radius + small.radius;
    Rigid rigid = scene(0, 10);
    rigid.boundaries.push_back(
        {"log", Obstacle{large, {0, 0, 0}, turn_about(Vec3::UnitZ(), quarter)}});
    const double start = 0.05;
    Body body = body_of(small, 700, {s * std::sin(start), 0.2, s * std::cos(start)});
    body.orientation = turn_about(Vec3::UnitZ(), quarter);
    rigid.bodies.push_back(body);
    double error = 0;
    double theta = start;
    run(rigid, 1e-3, 900, [&](double) {
        const Body& now = rigid.bodies[0];
        theta = std::atan2(now.position.x(), now.position.z());
        if (std::cos(theta) > 0.65) { // it leaves the surface at 4/7
            const double v2 = 4.0 / 3 * g * s * (std::cos(start) - std::cos(theta));
            error = std::max(error, std::abs(now.velocity.squaredNorm() - v2));
            EXPECT_NEAR(std::hypot(now.position.x(), now.position.z()), s, 1e-9);
        }
    });
    EXPECT_GE(theta, std::acos(0.65)); // it came so far
    EXPECT_LE(error, 1e-5 * g * s);    // second order in the step
}

TEST(RodRests, AcrossTwoRods)
{
    // Supports at -0.2 and 0.3 from the middle carry 3/5 and 2/5 of the weight.
    Rigid rigid = scene(0.3, 0.4);
    for (const double x : {-0.2, 0.3}) {
        rigid.boundaries.push_back(
            {"support", Obstacle{Rod{0.05, 0.5}, {x, 0.1, 0}, turn_about(Vec3::UnitZ(), quarter)}});
    }
    const Rod rod{0.08, 1.0};
    rigid.bodies.push_back(body_of(rod, 700, {0, 0, 0.13}));
    const std::vector<Contact> log = run(rigid, 1e-3, 300);
    ASSERT_EQ(log.size(), 600U);
    const double weight = rigid.bodies[0].mass.mass * g * 1e-3;
    for (const Contact& c : log) {
        EXPECT_NEAR(c.normal_impulse, (c.b == -1 ? 0.6 : 0.4) * weight, 1e-12 * weight);
        EXPECT_LE((c.point - Vec3(c.b == -1 ? -0.2 : 0.3, 0, 0.05)).norm(), 1e-9);
    }
    EXPECT_LE((rigid.bodies[0].position - Vec3(0, 0, 0.13)).norm(), 1e-12);
}

TEST(RodRests, AlongAnotherAndOnItsEnd)
{
    // on two parallel rods that touch: the middle is sqrt(3) r above theirs
    const Rod rod{0.1, 0.6};
    Rigid groove = scene(0.3, 0.4);
    groove.boundaries.push_back({"left", Obstacle{rod, {0, -0.1, 0}}});
    groove.boundaries.push_back({"right", Obstacle{rod, {0.1, 0.1, 0}}});
    groove.bodies.push_back(body_of(rod, 700, {0.05, 0, 0.1 * std::sqrt(3.0)}));
    run(groove, 1e-3, 300);
    EXPECT_LE((groove.bodies[0].position - Vec3(0.05, 0, 0.1 * std::sqrt(3.0))).norm(), 1e-10);

    // on end: on a box, half past its edge but for a tenth of the radius; and on the end of another
    const Quat upright = turn_about(Vec3::UnitY(), quarter);
    for (const bool on_rod : {false, true}) {
        Rigid rigid = scene(0.3, 0.4);
        if (on_rod) {
            rigid.boundaries.push_back({"rod", Obstacle{rod, {0, 0, -0.3}, upright}});
        } else {
            rigid.boundaries.push_back(block({1, 1, 0.4}, {-0.49, 0, 0}));
        }
        Body body = body_of(rod, 700, {on_rod ? 0.08 : 0.0, 0, 0.3});
        body.orientation = upright;
        rigid.bodies.push_back(body);
        double widest = 0;
        for (const Contact& c : run(rigid, 1e-3, 300)) {
            widest = std::max(widest, c.point.y());
        }
        // the patch ends where the rims cross, or with the disc over the edge
        EXPECT_NEAR(widest, on_rod ? std::sqrt(0.0084) : 0.1, 1e-9);
        EXPECT_LE((rigid.bodies[0].position - body.position).norm(), 1e-10) << on_rod;
        EXPECT_LE(rigid.bodies[0].orientation.angularDistance(upright), 1e-10) << on_rod;
    }
}

TEST(RodRests, InAGrooveThatItHitsNearlyParallel)
{
    // where it touches runs along the rods faster than they turn, until both ends lie
    for (const double yaw : {1e-6, 1e-4, 1e-2}) {
        Rigid rigid = scene(0.3, 0.5);
        rigid.boundaries.push_back({"left", Obstacle{Rod{0.08, 0.6}, {0, -0.08, 0}}});
        rigid.boundaries.push_back({"right", Obstacle{Rod{0.08, 0.6}, {0.05, 0.08, 0}}});
        rigid.bodies.push_back(body_of(Rod{0.08, 0.4}, 500, {0.02, 0, 0.15}));
        Body& body = rigid.bodies[0];
        body.orientation = Quat(Eigen::AngleAxisd(yaw, Vec3::UnitZ())) *
                           Quat(Eigen::AngleAxisd(1e-2, Vec3::UnitY()));
        double last = energy(rigid);
        run(rigid, 1e-3, 600, [&](double) {
            EXPECT_LE(energy(rigid), last + 1e-7 * body.mass.mass * g) << yaw;
            last = energy(rigid);
        });
        EXPECT_LE(rigid.counters.worst_penetration, 1e-5) << yaw;
        EXPECT_LE(body.velocity.norm(), 1e-9) << yaw;
        EXPECT_NEAR(body.position.z(), 0.08 * std::sqrt(3.0), 1e-9) << yaw;
    }
}

TEST(RodTips, AboutTheEdgeOfABox)
{
    // on end, its middle 1 cm past the edge: I_p omega^2 / 2 = M g times what the middle has sunk
    const Rod rod{0.1, 0.6};
    const Quat upright = turn_about(Vec3::UnitY(), quarter);
    Rigid rigid = scene(0.3, 0.8);
    rigid.boundaries.push_back(block({1, 1, 0.4}, {-0.51, 0, 0}));
    Body body = body_of(rod, 700, {0, 0, 0.3});
    body.orientation = upright;
    rigid.bodies.push_back(body);
    const double d = std::hypot(0.01, 0.3);
    const double I_p = body.mass.inertia(1, 1) + body.mass.mass * d * d;
    double turned = 0;
    run(rigid, 1e-3, 500, [&](double) {
        const Body& now = rigid.bodies[0];
        turned = now.orientation.angularDistance(upright);
        const double sunk = 0.3 - d * std::cos(std::atan2(0.01, 0.3) + turned);
        const double omega2 = angular_velocity(now).squaredNorm();
        EXPECT_NEAR(0.5 * I_p * omega2, body.mass.mass * g * sunk, 1e-5 * body.mass.mass * g);
    });
    EXPECT_GE(turned, 0.1);
}

TEST(RodRocks, OnABoxAsOnAPlane)
{
    // wobbles on the rim of its cap until little is left of it, and falls over
    for (const auto& [tilt, steps] : {std::pair(3.0, 450), {25.0, 600}}) {
        Rigid on_plane = scene(0.3, 0.4);
        on_plane.boundaries.push_back({"floor", Plane{}});
        Rigid on_box = scene(0.3, 0.4);
        on_box.boundaries.push_back(block({2, 2, 0.4}, {0, 0, 0}));
        const Rod rod{0.1, 0.3};
        Body body = body_of(rod, 700, {0, 0, 0.25});
        body.orientation =
            turn_about(Vec3(1, 2, 0).normalized(), tilt) * turn_about(Vec3::UnitY(), quarter);
        body.angular_momentum = angular_momentum(body, Vec3(0, 0, 3));
        on_plane.bodies.push_back(body);
        on_box.bodies.push_back(body);
        for (int k = 0; k < steps; ++k) {
            run(on_plane, 1e-3, 1);
            run(on_box, 1e-3, 1);
            const Body& a = on_plane.bodies[0];
            const Body& b = on_box.bodies[0];
            EXPECT_LE((a.position - b.position).norm(), 1e-8) << tilt << " " << k;
            EXPECT_LE(a.orientation.angularDistance(b.orientation), 1e-7) << tilt << " " << k;
        }
    }
}

TEST(RodHits, AnEdgeWithOneImpulse)
{
    // A ridge across the rod at 0.15 from its middle: J = (1 + e) v / (1/M + d^2/I).
    const Rod rod{0.05, 0.6};
    const double e = 0.4;
    const double d = 0.15;
    Rigid rigid = scene(e, 0);
    const double half = 0.1 * std::sqrt(2.0);
    rigid.boundaries.push_back(
        {"ridge",
         Obstacle{box_polytope({0.2, 1, 0.2}, 3), {d, 0, -half}, turn_about(Vec3::UnitY(), 45)}});
    const double fall = 0.1;
    rigid.bodies.push_back(body_of(rod, 700, {0, 0, rod.radius + fall}));
    const Body& body = rigid.bodies[0];
    const double v = std::sqrt(2 * g * fall);
    const double J = (1 + e) * v / (1 / body.mass.mass + d * d / body.mass.inertia(1, 1));
    const double time = v / g;
    run(rigid, 1e-3, 160);
    EXPECT_NEAR(body.velocity.z(), J / body.mass.mass - v - g * (0.16 - time), 1e-9);
    EXPECT_NEAR(angular_velocity(body).y(), -d * J / body.mass.inertia(1, 1), 1e-9);
}

TEST(RodHits, AnotherWithOneImpulse)
{
    // Crossed and skewed rods in mid-air, frictionless: u_n+ = -e u_n-, impulse along the common
    // perpendicular.
    for (const double skew : {90.0, 40.0, 8.0}) {
        Rigid rigid = scene(0.6, 0);
        rigid.settings.gravity.setZero();
        rigid.bodies.push_back(body_of(Rod{0.05, 0.6}, 700, {0, 0, 0}));
        rigid.bodies.push_back(body_of(Rod{0.03, 0.8}, 500, {0.1, 0.02, 0.2}));
        Body& a = rigid.bodies[0];
        Body& b = rigid.bodies[1];
        b.orientation = turn_about(Vec3::UnitZ(), skew);
        b.velocity = {0, 0, -1};
        const Vec3 w = b.orientation * Vec3::UnitX();
        // the axis of a is the x axis; b passes over it where y = 0
        const double along = 0.1 - 0.02 * w.x() / w.y();
        const Vec3 arm_a(along, 0, 0);
        const Vec3 arm_b = Vec3(along, 0, 0) - Vec3(0.1, 0.02, 0);
        const auto answer = [](const Body& body, const Vec3& arm) {
            const Mat3 R = body.orientation.toRotationMatrix();
            const Vec3 turn = arm.cross(Vec3::UnitZ());
            return 1 / body.mass.mass +
                   turn.dot(R * body.mass.inertia.inverse() * R.transpose() * turn);
        };
        const double J = 1.6 / (answer(a, arm_a) + answer(b, arm_b));
        const std::vector<Contact> log = run(rigid, 1e-3, 130);
        ASSERT_EQ(log.size(), 1U) << skew;
        EXPECT_NEAR(log[0].time, 0.12, 1e-10);
        EXPECT_NEAR(log[0].normal_impulse, J, 1e-10);
        EXPECT_LE((log[0].point - Vec3(along, 0, 0.05)).norm(), 1e-10);
        EXPECT_NEAR(a.velocity.z(), -J / a.mass.mass, 1e-9);
        EXPECT_NEAR(b.velocity.z(), J / b.mass.mass - 1, 1e-9);
    }
}

TEST(RodHits, RimOnRim)
{
    // Two rods meet rim to rim in mid-air: one impulse where both rims are, along the normal of
    // both tangents, with the restitution of the pair.
    Rigid rigid = scene(1, 0);
    rigid.settings.gravity.setZero();
    const Rod rod{0.1, 0.3};
    rigid.bodies.push_back(body_of(rod, 700, {0, 0, 0}));
    rigid.bodies.push_back(body_of(rod, 700, {0.4, 0.05, 0.1}));
    rigid.bodies[0].orientation = turn_about(Vec3::UnitZ(), 20);
    rigid.bodies[1].orientation = turn_about(Vec3::UnitY(), 20);
    rigid.bodies[1].velocity = {-1, 0, 0};
    const std::vector<Body> start = rigid.bodies;
    const double before = energy(rigid);
    std::vector<Contact> log;
    for (int k = 0; k < 200 && log.empty(); ++k) {
        log = run(rigid, 1e-3, 1, {}, 1e-3 * k);
    }
    ASSERT_EQ(log.size(), 1U);
    EXPECT_NEAR(energy(rigid), before, 1e-12 * before);
    double answer = 0;
    for (const Body& body : start) {
        const Vec3 arm = log[0].point - body.position - log[0].time * body.velocity;
        const Mat3 R = body.orientation.toRotationMatrix();
        const Vec3 p = R.transpose() * arm;
        EXPECT_NEAR(std::abs(p.x()), rod.length / 2, 1e-10);
        EXPECT_NEAR(std::hypot(p.y(), p.z()), rod.radius, 1e-10);
        EXPECT_NEAR(log[0].normal.dot(R * Vec3(0, -p.z(), p.y())), 0, 1e-10);
        const Vec3 turn = arm.cross(log[0].normal);
        answer +=
            1 / body.mass.mass + turn.dot(R * body.mass.inertia.inverse() * R.transpose() * turn);
    }
    EXPECT_NEAR(log[0].normal_impulse, -2 * log[0].normal.x() / answer, 1e-9);
}

TEST(RodOnMesh, MovesAsOnTheBlockOfTheSameSurface)
{
    // across the edges, along an edge, over a corner, and on end half past an edge and a corner
    const Polytope top = box_polytope({0.4, 0.5, 0.2}, 3);
    struct Pose {
        Vec3 position;
        Quat turn;
    };
    for (const auto& [position, turn] :
         {Pose{{0.02, 0, 0.2}, Quat::Identity()},
          Pose{{0.1, 0, 0.2}, turn_about(Vec3(1, 1, 0).normalized(), 20)},
          Pose{{0.19, 0.02, 0.2}, turn_about(Vec3::UnitZ(), quarter)},
          Pose{{0.15, 0.2, 0.25}, turn_about(Vec3(1, -1, 1).normalized(), 50)},
          Pose{{0.19, 0.1, 0.5}, turn_about(Vec3::UnitY(), quarter)},
          Pose{{0.19, 0.24, 0.32}, turn_about(Vec3::UnitY(), quarter - 2)}}) {
        Rigid block = scene(0.3, 0.3);
        block.boundaries.push_back({"block", Obstacle{top, {0, 0, -0.1}}});
        Rigid mesh = scene(0.3, 0.3);
        mesh.boundaries.push_back({"mesh", surface_of(top, {0, 0, -0.1})});
        Body body = body_of(Rod{0.06, 0.6}, 700, position);
        body.orientation = turn;
        block.bodies.push_back(body);
        mesh.bodies.push_back(body);
        for (int k = 0; k < 300; ++k) {
            run(block, 1e-3, 1);
            run(mesh, 1e-3, 1);
            const Body& a = block.bodies[0];
            const Body& b = mesh.bodies[0];
            EXPECT_LE((a.position - b.position).norm(), 1e-7) << position.transpose() << " " << k;
        }
    }
}

} // namespace
} // namespace hyoryu::test_rods
