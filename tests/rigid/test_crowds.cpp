// SPDX-License-Identifier: MIT
// Accuracy must not depend on how many other bodies are near: families of rows, stacks and wet
// piles, drawn around the numbers at which the method once changed.
#include "dice.hpp"
#include "rigid/contact/block_matrix.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace hyoryu::test_crowds {
namespace {

using namespace test;

class Draw {
public:
    explicit Draw(unsigned seed) : engine_(seed) {}
    double between(double low, double high)
    {
        return low + (high - low) * (static_cast<double>(engine_() >> 5) / 134217728.0); // 2^27
    }

private:
    std::mt19937 engine_;
};

std::vector<Vec3> positions(const Rigid& rigid)
{
    std::vector<Vec3> list;
    for (const Body& body : rigid.bodies) {
        list.push_back(body.position);
    }
    return list;
}

// Height of the lowest point at t of what falls from `height`, and bounces with restitution e.
double bounced(double height, double e, double t)
{
    const double first = std::sqrt(2 * height / g);
    if (t <= first) {
        return height - 0.5 * g * t * t;
    }
    double rest = t - first;
    double speed = e * g * first;
    while (rest > 2 * speed / g && speed > 1e-6) {
        rest -= 2 * speed / g;
        speed *= e;
    }
    return std::max(0.0, speed * rest - 0.5 * g * rest * rest);
}

TEST(Crowds, CubesThatFallFlatBesideEachOtherKeepTheirParabola)
{
    Draw draw(1);
    for (const int n : {1, 2, 5, 6, 10, 11, 12, 23, 40}) {
        Rigid rigid = on_floor(0.75, 0.3);
        double x = 0;
        for (int k = 0; k < n; ++k) {
            x += cube_size().x() + draw.between(1e-4, 2e-3);
            rigid.bodies.push_back(box(cube_size(), 250, {x, draw.between(-1e-3, 1e-3), 0.125}));
        }
        double off = 0;
        run(rigid, 1e-3, 600, [&](double t) {
            for (const Body& body : rigid.bodies) {
                off = std::max(off, std::abs(body.position.z() - 0.025 - bounced(0.1, 0.75, t)));
            }
        });
        EXPECT_LE(off, 1e-6) << n; // a thousandth of a millimetre
        EXPECT_EQ(rigid.counters.capped_steps, 0) << n;
    }
}

// A table that does not move is as a wall: what rattles on one end of it is not seen on the other.
TEST(Crowds, PairsThatRattleOnOneFixedTableDoNotSeeEachOther)
{
    Draw draw(3);
    for (const double dt : {0.2, 0.1, 0.05}) {
        Body table = box(Vec3(20, 1, 0.2), 600, {0, 0, -0.1});
        table.locks.fill(true);
        Rigid all = scene(draw.between(0.9, 0.96), 0.3);
        all.bodies.push_back(table);
        std::vector<Rigid> alone;
        for (int pair = 0; pair < 12; ++pair) {
            Rigid& one = alone.emplace_back();
            one.settings = all.settings;
            one.laws = all.laws;
            one.bodies = {table};
            for (const double beside : {0.0, 0.20001}) { // which makes them one group
                const Vec3 at(0.7 * pair + beside, 0, 0.1 + draw.between(0.002, 0.05));
                one.bodies.push_back(body_of(Ball{0.1}, 600, at));
                all.bodies.push_back(one.bodies.back());
            }
            run(one, dt, 30);
        }
        run(all, dt, 30);
        for (std::size_t k = 1; k < all.bodies.size(); ++k) {
            const Body& one = alone[(k - 1) / 2].bodies[1 + (k - 1) % 2];
            EXPECT_EQ(all.bodies[k].position, one.position) << k << ", " << dt;
            EXPECT_EQ(all.bodies[k].velocity, one.velocity) << k << ", " << dt;
        }
    }
}

// Boxes of edge a on one another, the density growing to `ratio` times the first upwards.
Rigid tower(int n, double a, double ratio)
{
    Rigid rigid = on_floor(0.3, 0.5);
    for (int k = 0; k < n; ++k) {
        const double density = 10 * std::pow(ratio, n > 1 ? k / (n - 1.0) : 0);
        rigid.bodies.push_back(box(Vec3::Constant(a), density, {0, 0, a * (k + 0.5)}));
    }
    return rigid;
}

double way_of_top(Rigid& rigid, double dt, double time)
{
    const Vec3 start = rigid.bodies.back().position;
    run(rigid, dt, static_cast<int>(std::lround(time / dt)));
    return (rigid.bodies.back().position - start).norm();
}

TEST(Crowds, TowersOfAnyHeightStand)
{
    struct Case {
        int boxes;
        double dt, time;
    };
    for (const auto& [boxes, dt, time] :
         {Case{10, 1e-2, 5}, Case{11, 1e-2, 5}, Case{15, 5e-3, 5}, Case{20, 1e-2, 5},
          Case{30, 1e-2, 5}, Case{30, 1e-3, 0.5}}) {
        Rigid rigid = tower(boxes, 0.2, 1);
        EXPECT_LE(way_of_top(rigid, dt, time), 1e-6) << boxes << " boxes, " << dt;
        EXPECT_EQ(rigid.counters.capped_steps, 0);
    }
}

TEST(Crowds, TowersThatGrowHeavierUpwardsStand)
{
    Draw draw(2);
    for (const double dt : {1e-2, 5e-3, 1e-3}) {
        const double ratio = std::pow(10, draw.between(1, 3));
        for (const double r : {ratio, 1000.0}) {
            Rigid rigid = tower(12, 0.2, r);
            EXPECT_LE(way_of_top(rigid, dt, std::min(5.0, 500 * dt)), 1e-6) << r << ", " << dt;
            EXPECT_EQ(rigid.counters.capped_steps, 0);
        }
    }
}

// Boxes of any size on one another, none more than a sixth off the middle of the one below, their
// densities a thousand to one in any order. HYORYU_STACKS=60 is the nightly number.
TEST(Crowds, TowersOfMixedDensitiesStand)
{
    for (int seed = 1; seed <= number_from("HYORYU_STACKS", 8); ++seed) {
        Draw draw(seed);
        const int n = static_cast<int>(draw.between(10, 35));
        const double dt = std::array{1e-3, 5e-3, 1e-2}[static_cast<std::size_t>(seed % 3)];
        Rigid rigid = on_floor(0.3, 0.5);
        double height = 0;
        for (int k = 0; k < n; ++k) {
            const Vec3 size{draw.between(0.8, 1.2), draw.between(0.8, 1.2), draw.between(0.2, 0.5)};
            const Vec3 foot{draw.between(-0.05, 0.05), draw.between(-0.05, 0.05), height};
            const double density = std::pow(10, draw.between(1, 4));
            rigid.bodies.push_back(box(size, density, foot + size.z() / 2 * Vec3::UnitZ()));
            height += size.z();
        }
        EXPECT_LE(way_of_top(rigid, dt, std::min(1.0, 200 * dt)), 1e-9)
            << seed << ": " << n << " boxes, steps of " << dt;
        EXPECT_EQ(rigid.counters.capped_steps, 0) << seed;
    }
}

// Lift of half the weight, and water that pushes and turns each box otherwise in every step.
std::vector<Wrench> water(const Rigid& rigid, double part, Draw& draw)
{
    std::vector<Wrench> loads;
    for (const Body& body : rigid.bodies) {
        const double weight = body.mass.mass * g;
        const auto push = [&](double most) { return weight * draw.between(-most, most); };
        loads.push_back({{push(0.1 * part), push(0.1 * part), 0.5 * weight + push(part)},
                         {push(0.01 * part), push(0.01 * part), push(0.01 * part)}});
    }
    return loads;
}

TEST(Crowds, PilesInWaterRestThoughEveryStepLoadsThemAnew)
{
    Draw draw(3);
    for (const int n : {3, 12, 20}) {
        for (const double part : {0.05, 0.2}) {
            Rigid rigid = tower(n, 0.2, 1);
            const Vec3 start = rigid.bodies.back().position;
            std::vector<Contact> log;
            for (int k = 0; k < 200; ++k) {
                step(rigid, k * 5e-3, 5e-3, water(rigid, part, draw), log);
            }
            // g h times what a solution may leave, 1e-6, in each of 200 steps, were they all alike
            EXPECT_LE((rigid.bodies.back().position - start).norm(), 200 * 5e-3 * 1e-6 * g * 5e-3)
                << n << " boxes, " << part;
            EXPECT_EQ(rigid.counters.capped_steps, 0);
        }
    }
}

// A wall of bricks that grows narrower upwards, each on the joint of two others, 1 mm apart beside
// each other.
Rigid brick_wall(int courses, int wide, double a)
{
    Rigid rigid = on_floor(0.2, 0.5);
    for (int course = 0; course < courses; ++course) {
        for (int k = 0; k < wide - course; ++k) {
            rigid.bodies.push_back(
                box({2 * a, a, a}, 500,
                    {(2 * a + 1e-3) * k + (a + 5e-4) * course, 0, a * (course + 0.5)}));
        }
    }
    return rigid;
}

TEST(Crowds, AHundredBricksInWaterAreLocated)
{
    Draw draw(4);
    struct Wall {
        int courses, wide;
        std::size_t bodies, contacts; // at least
        double top;                   // by which the top brick may move [m]
    };
    for (const Wall& wall : {Wall{10, 14, 95, 700, 1e-7}, Wall{10, 19, 140, 1000, 1e-6}}) {
        Rigid rigid = brick_wall(wall.courses, wall.wide, draw.between(0.15, 0.3));
        ASSERT_GE(rigid.bodies.size(), wall.bodies);
        const std::vector<Vec3> start = positions(rigid);
        std::vector<Contact> log;
        for (int k = 0; k < 20; ++k) {
            log.clear();
            step(rigid, k * 1e-3, 1e-3, water(rigid, 0.02, draw), log);
        }
        EXPECT_GE(log.size(), wall.contacts);
        for (std::size_t k = 0; k < start.size(); ++k) {
            // Like the top of a dry tower: a thousandth of a millimetre.
            EXPECT_LE((rigid.bodies[k].position - start[k]).norm(), 1e-6) << "brick " << k;
        }
        EXPECT_LE((rigid.bodies.back().position - start.back()).norm(), wall.top);
        EXPECT_EQ(rigid.counters.capped_steps, 0);
    }
}

TEST(Crowds, ABlowIsPassedOnWithinTheStepByBodiesThatDidNotMoveTowardsEachOther)
{
    Draw draw(5);
    for (const double speed : {3.0, 8.0, 20.0}) { // 3 to 20 cm in a step
        Rigid rigid = scene(1, 0);
        rigid.settings.gravity = Vec3::Zero();
        const Vec3 way = Vec3{draw.between(-1, 1), draw.between(-1, 1), 1}.normalized();
        double x = 0;
        for (int k = 0; k < 6; ++k) {
            rigid.bodies.push_back(body_of(Ball{0.05}, 1000, x * way));
            x += 0.1 + draw.between(1e-4, 2e-3);
        }
        rigid.bodies[0].position -= 0.01 * way;
        rigid.bodies[0].velocity = speed * way;
        run(rigid, 1e-2, 20);
        for (std::size_t k = 0; k < 5; ++k) {
            EXPECT_LE(rigid.bodies[k].velocity.norm(), 1e-9 * speed);
        }
        EXPECT_LE((rigid.bodies[5].velocity - speed * way).norm(), 1e-9 * speed);
        EXPECT_LE(rigid.counters.worst_penetration, 1e-9); // of what was found, one step later
    }
}

// Cubes rattle in shafts on both sides of a tower, an inch from it: it does not feel it.
TEST(Crowds, ATowerStandsBesideCubesThatRattle)
{
    Rigid rigid = tower(12, 0.2, 100);
    for (const double side : {-1.0, 1.0}) {
        const Obstacle slab{box_polytope({0.008, 2, 6}, 3), {side * 0.108, 0, 3}};
        rigid.boundaries.push_back({"slab", slab});
    }
    const Vec3 start = rigid.bodies.back().position;
    Draw draw(6);
    for (int k = 0; k < 20; ++k) {
        const double side = k % 2 == 0 ? -1 : 1;
        Body cube = box(Vec3::Constant(0.05), 500,
                        {side * 0.16, -0.1 + 0.06 * (k / 2 % 4), 0.2 + 0.05 * k});
        cube.orientation = turn_about(Vec3(0, 0, 1), draw.between(-5, 5)) *
                           turn_about(Vec3(1, 0, 0), draw.between(-5, 5));
        rigid.bodies.push_back(cube);
    }
    const std::vector<Contact> log = run(rigid, 5e-3, 200);
    EXPECT_GT(log.size(), 1000U);
    EXPECT_LE((rigid.bodies[11].position - start).norm(), 1e-6);
    const bool all_located = std::ranges::all_of(log, &Contact::located);
    EXPECT_EQ(all_located, rigid.counters.capped_steps == 0);
}

TEST(Crowds, BlocksAreEliminatedAsADenseMatrixIs)
{
    Draw draw(7);
    constexpr int n = 9;
    const std::vector<std::pair<int, int>> pairs{{0, 1}, {1, 2}, {2, 3}, {0, 8}, {3, 8},
                                                 {4, 5}, {5, 8}, {1, 7}, {6, 7}};
    BlockMatrix matrix;
    order(matrix, n, pairs);
    set_identity(matrix);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Identity(6 * n, 6 * n);
    const auto random = [&] {
        return Mat6(Mat6::NullaryExpr([&] { return draw.between(-1, 1); }));
    };
    const auto add = [&](int i, int j) {
        const Mat6 block = random();
        matrix.at(matrix.step_of[static_cast<std::size_t>(i)],
                  matrix.step_of[static_cast<std::size_t>(j)]) += block;
        dense.block<6, 6>(6 * i, 6 * j) += block;
    };
    for (int k = 0; k < n; ++k) {
        add(k, k);
    }
    for (const auto& [a, b] : pairs) {
        add(a, b);
        add(b, a);
    }
    Eigen::VectorXd right =
        Eigen::VectorXd::NullaryExpr(6 * n, [&] { return draw.between(-1, 1); });
    std::vector<Vec6> x(n);
    for (int k = 0; k < n; ++k) {
        x[static_cast<std::size_t>(matrix.step_of[static_cast<std::size_t>(k)])] =
            right.segment<6>(6 * k);
    }
    factorise(matrix);
    solve(matrix, x);
    const Eigen::VectorXd exact = dense.partialPivLu().solve(right);
    for (int k = 0; k < n; ++k) {
        const auto& part = x[static_cast<std::size_t>(matrix.step_of[static_cast<std::size_t>(k)])];
        // round-off times the condition of random blocks
        EXPECT_LE((part - exact.segment<6>(6 * k)).norm(), 1e-9 * exact.norm());
    }
}

} // namespace
} // namespace hyoryu::test_crowds
