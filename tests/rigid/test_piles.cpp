// SPDX-License-Identifier: MIT
// Stacks and mass ratios that must stand still (contact notes, scenes (d) and (e); tests T9, T10).
#include "scenes.hpp"

#include "hyoryu/core/parallel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hyoryu::test_piles {
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

// Boxes of 10 cm in columns, a little turned and shifted, falling into a basin; each layer is moved
// by `lock` to one side and the next to the other [m].
Rigid heap(int side, int layers, double lock = 0)
{
    Rigid rigid = scene(0.3, 0.5);
    const double half = 0.07 * side;
    Basin basin{{-half, -half, 0}, {half, half, 10}, {}};
    basin.open[5] = true;
    rigid.boundaries.push_back({"basin", basin});
    const auto number = [](int k) { return std::sin(12.9898 * k) * 0.5; };
    for (int k = 0; k < side * side * layers; ++k) {
        const Vec3 place(0.14 * (k % side + 0.5) - half, 0.14 * (k / side % side + 0.5) - half,
                         0.08 + 0.16 * (k / (side * side)));
        const Vec3 aside = (k / (side * side) % 2 == 0 ? lock : -lock) * Vec3(1, 1, 0);
        Body body =
            box(Vec3::Constant(0.1), 500, place + aside + 0.01 * Vec3(number(k), number(k + 7), 0));
        body.orientation =
            turn_about(Vec3(number(k + 1), number(k + 2), 1).normalized(), 10 * number(k));
        rigid.bodies.push_back(body);
    }
    return rigid;
}

TEST(Piles, HeapSettlesWithoutGainOfEnergyAndStaysInItsBasin)
{
    Rigid rigid = heap(3, 5);
    const double start = energy(rigid);
    double most = start;
    run(rigid, 1e-3, 1200, [&](double) { most = std::max(most, energy(rigid)); });
    // Only the projection of overlaps may lift: less than the weight of all boxes times 0.1 mm.
    EXPECT_LE(most, start + 45 * 0.5 * g * 1e-4);
    double motion = 0;
    for (const Body& body : rigid.bodies) {
        motion += kinetic_energy(body);
        EXPECT_GT(body.position.z(), 0.045);
        EXPECT_LT(body.position.cwiseAbs().head<2>().maxCoeff(), 3 * 0.07 - 0.045);
    }
    EXPECT_LE(motion, 1e-3 * start); // what is left is rattle
    // v dt of the fastest fall, 2.5 m/s, twice over: an unlocated step does not locate its impacts
    EXPECT_LE(rigid.counters.worst_penetration, 5e-3);
}

// More contacts are pressed than the boxes have freedoms: all cannot have a gap of zero.
TEST(Piles, LockedHeapRestsWithoutOverlap)
{
    Rigid rigid = heap(3, 6, 0.025);
    run(rigid, 1e-3, 1200);
    rigid.counters.worst_penetration = 0;
    rigid.counters.capped_steps = 0;
    run(rigid, 1e-3, 50);
    EXPECT_EQ(rigid.counters.capped_steps, 0); // at rest every step is located
    // What the projection leaves alone and what the speeds that are left of the contacts, 1e-6 m/s,
    // make of it in a step: 1e-9 m each; doubled.
    EXPECT_LE(rigid.counters.worst_penetration, 4e-9);
}

TEST(Piles, HeapGoesOnWithTheSameBitsAfterARestart)
{
    Rigid one = heap(3, 3);
    Rigid two = heap(3, 3);
    run(one, 1e-3, 400);
    run(two, 1e-3, 200);
    const ContactStart kept = contact_start(two);
    set_contact_start(two, kept);
    run(two, 1e-3, 200, {}, 0.2);
    for (std::size_t k = 0; k < one.bodies.size(); ++k) {
        EXPECT_EQ(one.bodies[k].position, two.bodies[k].position);
    }
}

// Courses of boxes, every other one shifted by half a box both ways, so that all stand in one
// island of thousands of contacts.
Rigid masonry(int side, int courses)
{
    Rigid rigid = on_floor(0.0, 0.5);
    for (int k = 0; k < side * side * courses; ++k) {
        const int course = k / (side * side);
        const double shift = course % 2 == 0 ? 0.0 : 0.05;
        rigid.bodies.push_back(box(
            Vec3::Constant(0.1), 500,
            {0.11 * (k % side) + shift, 0.11 * (k / side % side) + shift, 0.05 + 0.1 * course}));
    }
    return rigid;
}

TEST(Piles, MasonryStandsWithTheSameBitsForAnyThreads)
{
    std::vector<std::vector<Vec3>> ends;
    for (const int threads : {1, 2, 3}) {
        set_threads(threads);
        Rigid rigid = masonry(8, 4);
        const std::vector<Vec3> start = positions(rigid);
        run(rigid, 1e-3, 4);
        // Of the free fall, sweeps that start from nothing may leave a thousandth.
        EXPECT_LE(largest_drift(rigid, start), 1e-3 * 0.5 * g * sq(4e-3));
        ends.push_back(positions(rigid));
    }
    set_threads(0);
    EXPECT_EQ(ends[0], ends[1]);
    EXPECT_EQ(ends[0], ends[2]);
}

} // namespace
} // namespace hyoryu::test_piles
