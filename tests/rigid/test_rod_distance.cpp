// SPDX-License-Identifier: MIT
// Distances of cylinders from cylinders and boxes against alternating projections.
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace hyoryu::test_rod_distance {
namespace {

using namespace test;

Vec3 nearest_on(const ContactShape& shape, const Body& body, const Vec3& point)
{
    const Mat3 R = body.orientation.toRotationMatrix();
    Vec3 p = R.transpose() * (point - body.position);
    if (const auto* rod = std::get_if<Rod>(&shape)) {
        p.x() = std::clamp(p.x(), -rod->length / 2, rod->length / 2);
        const double r = std::hypot(p.y(), p.z());
        p.tail<2>() *= r > rod->radius ? rod->radius / r : 1;
    } else {
        const Vec3 half = std::get<Polytope>(shape).corners.back().cwiseAbs();
        p = p.cwiseMax(-half).cwiseMin(half);
    }
    return body.position + R * p;
}

Quat random_turn(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    return Quat(normal(random), normal(random), normal(random), normal(random)).normalized();
}

TEST(RodDistance, IsThatOfAlternatingProjections)
{
    // Move two solids from random places to 1 micrometre of each other, and as deep into each
    // other, along the line between their nearest points.
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(-1, 1);
    const Rod rod{0.05, 0.3};
    for (const ContactShape& other :
         {ContactShape(Rod{0.08, 0.2}), ContactShape(box_polytope({0.2, 0.3, 0.1}, 3))}) {
        int compared = 0;
        for (int trial = 0; trial < 400; ++trial) {
            Rigid rigid = scene(0, 0);
            rigid.bodies.push_back(body_of(rod, 500, {0, 0, 0}));
            const Vec3 direction = Vec3(unit(random), unit(random), unit(random)).normalized();
            rigid.bodies.push_back(body_of(other, 500, 0.5 * direction));
            rigid.bodies[0].orientation = random_turn(random);
            rigid.bodies[1].orientation = random_turn(random);
            Vec3 p = Vec3::Zero();
            Vec3 q = rigid.bodies[1].position;
            double moved = 1;
            for (int k = 0; k < 20000 && moved > 1e-15; ++k) {
                const Vec3 next = nearest_on(rod, rigid.bodies[0], q);
                moved = (next - p).norm();
                p = next;
                q = nearest_on(other, rigid.bodies[1], p);
            }
            if (moved > 1e-14) {
                continue; // nearly parallel surfaces: the projections creep
            }
            ++compared;
            const Vec3 place = rigid.bodies[1].position;
            const double distance = (q - p).norm();
            for (const double depth : {-1e-6, 1e-6}) {
                rigid.bodies[1].position = place - (distance + depth) / distance * (q - p);
                const double found = overlap(rigid, 0, 1, 0);
                if (depth < 0) {
                    EXPECT_NEAR(found, depth, 1e-10) << trial;
                } else { // a corner may have a shorter way out
                    EXPECT_GT(found, 0) << trial;
                    EXPECT_LE(found, depth + 1e-10) << trial;
                }
            }
        }
        EXPECT_GE(compared, 300);
    }
}

} // namespace
} // namespace hyoryu::test_rod_distance
