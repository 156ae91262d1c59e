// SPDX-License-Identifier: MIT
// Stacks and mass ratios that must stand still (contact notes, scenes (d) and (e); tests T9, T10).
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hyoryu {
namespace {

using namespace test;

// Boxes of edge a on one another, of the given masses.
Rigid stack(double a, const std::vector<double>& masses)
{
    Rigid rigid = on_floor(0.0, 0.5);
    double z = a / 2;
    for (const double mass : masses) {
        rigid.bodies.push_back(box(Vec3::Constant(a), mass / (a * a * a), {0, 0, z}));
        z += a;
    }
    return rigid;
}

double largest_drift(const Rigid& rigid, const std::vector<Vec3>& start)
{
    double drift = 0;
    for (std::size_t k = 0; k < start.size(); ++k) {
        drift = std::max(drift, (rigid.bodies[k].position - start[k]).norm());
    }
    return drift;
}

std::vector<Vec3> positions(const Rigid& rigid)
{
    std::vector<Vec3> list;
    for (const Body& body : rigid.bodies) {
        list.push_back(body.position);
    }
    return list;
}

void expect_still(Rigid& rigid, double dt, int steps, double drift)
{
    const std::vector<Vec3> start = positions(rigid);
    run(rigid, dt, steps);
    EXPECT_LE(largest_drift(rigid, start), drift);
    double motion = 0;
    for (const Body& body : rigid.bodies) {
        motion += kinetic_energy(body);
    }
    EXPECT_LE(motion, 1e-15);
}

TEST(Piles, TenBoxesStand)
{
    Rigid rigid = stack(0.2, std::vector<double>(10, 8.0));
    expect_still(rigid, 1e-3, 1000, 1e-9);
}

TEST(Piles, PyramidStands)
{
    Rigid rigid = on_floor(0.0, 0.5);
    for (const Vec3& p : {Vec3(-0.22, 0, 0.1), Vec3(0, 0, 0.1), Vec3(0.22, 0, 0.1),
                          Vec3(-0.11, 0, 0.3), Vec3(0.11, 0, 0.3), Vec3(0, 0, 0.5)}) {
        rigid.bodies.push_back(box(Vec3::Constant(0.2), 1000, p));
    }
    expect_still(rigid, 1e-3, 500, 1e-9);
}

TEST(Piles, HeavyOnLightStands)
{
    for (const double heavy : {100.0, 1000.0}) {
        Rigid two = stack(0.2, {1, heavy});
        expect_still(two, 1e-2, 500, 1e-9);
        Rigid five = stack(0.2, {1, 1, 1, 1, heavy});
        expect_still(five, 1e-2, 500, 1e-9);
    }
}

TEST(Piles, BoxRestsOnABoxObstacle)
{
    Rigid rigid = scene(0.4, 0.3);
    Obstacle house{box_polytope({2, 2, 1}, 3), {0, 0, 0.5}};
    rigid.boundaries.push_back({"house", house});
    rigid.bodies.push_back(box(Vec3(0.3, 0.2, 0.1), 500, {0.2, 0.1, 1.05}));
    expect_still(rigid, 1e-3, 500, 1e-9);
}

} // namespace
} // namespace hyoryu
