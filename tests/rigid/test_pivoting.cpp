// SPDX-License-Identifier: MIT
// Contacts without friction under heavy bodies: the conditions that their impulses have to meet,
// checked with velocities summed here.
#include "dice.hpp"

#include "rigid/contact/solver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hyoryu::test_pivoting {
namespace {

using test::Dice;

// Bodies on one another, each up to ten times as heavy as the one below, with contacts whose
// normals are tilted and that ask for speeds of either sign.
struct Column {
    std::vector<Response> bodies, start;
    std::vector<Vec3> centres;
    std::vector<Row> rows;

    explicit Column(int seed)
    {
        Dice dice(seed);
        const int levels = 2 + static_cast<int>(dice.between(0, 4));
        double mass = 0.5;
        for (int k = 0; k < levels; ++k) {
            Response body;
            body.inverse_mass = Vec3::Constant(1 / mass);
            body.inverse_inertia = 12 / mass * Mat3::Identity();
            body.v = dice.within(0.1) - 0.5 * Vec3::UnitZ();
            body.omega = dice.within(0.3);
            bodies.push_back(body);
            centres.push_back(Vec3{dice.between(-0.1, 0.1), dice.between(-0.1, 0.1), k + 0.5});
            mass *= dice.between(1, 10);
        }
        start = bodies;
        for (int k = 0; k < levels; ++k) {
            const int contacts = 1 + static_cast<int>(dice.between(0, 5));
            for (int c = 0; c < contacts; ++c) {
                add_contact(k, dice);
            }
        }
    }

    void add_contact(int k, Dice& dice)
    {
        Touch touch;
        touch.point = {dice.between(-0.5, 0.5), dice.between(-0.5, 0.5), 1.0 * k};
        touch.normal = (Vec3::UnitZ() + dice.within(0.2)).normalized();
        Row row;
        row.a = k;
        row.b = k - 1;
        const Vec3 xa = centres[static_cast<std::size_t>(k)];
        const Vec3 xb = k > 0 ? centres[static_cast<std::size_t>(k - 1)] : xa;
        complete(row, {touch, touch}, {xa, xb, xa, xb}, bodies, 3);
        row.cone.size = 1;
        row.before = velocity(row, bodies);
        row.target = dice.between(-0.3, 0.1);
        rows.push_back(row);
    }
};

// The velocities that the impulses lead to, in the order of the bodies.
std::vector<Twist> summed(const Column& column)
{
    std::vector<Twist> twists;
    for (const Response& body : column.start) {
        twists.push_back({body.v, body.omega});
    }
    for (const Row& row : column.rows) {
        const Vec3 P = row.B * row.p;
        const auto push = [&](int k, double sign, const Mat3& turn) {
            const auto body = static_cast<std::size_t>(k);
            twists[body].v += sign * column.start[body].inverse_mass.cwiseProduct(P);
            twists[body].omega += sign * (column.start[body].inverse_inertia * (turn * row.p));
        };
        push(row.a, 1, row.turn_a);
        if (row.b >= 0) {
            push(row.b, -1, row.turn_b);
        }
    }
    return twists;
}

double normal_speed(const Row& row, const std::vector<Twist>& twists)
{
    const auto of = [&](int k, const Mat3& lever) {
        const Twist& twist = twists[static_cast<std::size_t>(k)];
        return row.D.col(0).dot(twist.v) + lever.col(0).dot(twist.omega);
    };
    return of(row.a, row.lever_a) - (row.b >= 0 ? of(row.b, row.lever_b) : 0);
}

TEST(Pivoting, EveryContactEitherPressesOrIsFasterThanAsked)
{
    constexpr double enough = 1e-6; // of speeds of 0.5 m/s; the shift is 1e-8
    double swept = 0;
    for (int seed = 1; seed <= 500; ++seed) {
        Column column(seed);
        SolverWork work;
        solve_by_pivoting(column.rows, column.bodies, work);
        const std::vector<Twist> twists = summed(column);
        for (const Row& row : column.rows) {
            const double excess = normal_speed(row, twists) - row.target;
            EXPECT_GE(row.p[0], 0) << "seed " << seed;
            EXPECT_GT(excess, -enough) << "seed " << seed;
            EXPECT_LT(std::min(excess, row.p[0] * row.cone.K(0, 0)), enough) << "seed " << seed;
        }
        Column other(seed);
        gauss_seidel(other.rows, other.bodies, {60, 0});
        swept = std::max(swept, residual(other.rows, other.bodies));
    }
    EXPECT_GT(swept, 100 * enough) << "sweeps would have done";
}

} // namespace
} // namespace hyoryu::test_pivoting
