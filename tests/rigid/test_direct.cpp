// SPDX-License-Identifier: MIT
// The direct solution of contact problems whose impulses are known in closed form.
#include "rigid/solver.hpp"

#include <gtest/gtest.h>

namespace hyoryu {
namespace {

Response cube(double mass, double inverse_moment)
{
    Response body;
    body.inverse_mass = Vec3::Constant(1 / mass);
    body.inverse_inertia = inverse_moment * Mat3::Identity();
    return body;
}

// A contact without friction whose normal points up, on body a; b < 0 is the floor.
Row contact(int a, int b, const Vec3& point, const std::vector<Vec3>& centres,
            const std::vector<Response>& bodies)
{
    Touch touch;
    touch.point = point;
    touch.normal = Vec3::UnitZ();
    const Vec3& xa = centres[static_cast<std::size_t>(a)];
    const Vec3& xb = b >= 0 ? centres[static_cast<std::size_t>(b)] : xa;
    Row row;
    row.a = a;
    row.b = b;
    complete(row, {touch, touch}, {xa, xb, xa, xb}, bodies, 3);
    row.before = velocity(row, bodies);
    return row;
}

void solve(std::vector<Row>& rows, std::vector<Response>& bodies)
{
    SolverWork work;
    guess_states(rows, work);
    EXPECT_TRUE(solve_directly(rows, bodies, work));
}

TEST(Direct, FourCornersShareAnUnevenLoadBySmallestNorm)
{
    // Of all impulses that stop the cube, those linear in the place have the smallest norm:
    // p = m v / 4 + omega_y / J^-1 * x / (4 x^2).
    constexpr double mass = 2;
    constexpr double inverse_moment = 5;
    constexpr double half = 0.3;
    std::vector<Response> bodies{cube(mass, inverse_moment)};
    bodies[0].v = {0, 0, -1};
    bodies[0].omega = {0, 0.4, 0};
    std::vector<Row> rows;
    for (const double x : {-half, half}) {
        for (const double y : {-half, half}) {
            rows.push_back(contact(0, -1, {x, y, 0}, {{0, 0, half}}, bodies));
        }
    }
    solve(rows, bodies);
    for (const Row& row : rows) {
        const double lever = 0.4 / (inverse_moment * 4 * half * half) * row.arm_a.x();
        // the shift of 1e-8 leaves the round-off of the sharing eight digits short
        EXPECT_NEAR(row.p[0], mass / 4 + lever, 1e-8);
    }
    EXPECT_LT(bodies[0].v.norm() + bodies[0].omega.norm(), 1e-12);
}

TEST(Direct, AMassRatioBeyondTheShiftIsSolvedAsWell)
{
    constexpr double ratio = 1e9; // 1e-9 of the diagonal, below the shift
    std::vector<Response> bodies{cube(1, 0), cube(ratio, 0)};
    const std::vector<Vec3> centres{{0, 0, 0.5}, {0, 0, 1.5}};
    for (Response& body : bodies) {
        body.v = {0, 0, -1};
    }
    std::vector<Row> rows{contact(0, -1, {0, 0, 0}, centres, bodies),
                          contact(1, 0, {0, 0, 1}, centres, bodies)};
    solve(rows, bodies);
    EXPECT_NEAR(rows[0].p[0] / (1 + ratio), 1, 1e-6); // round-off times the ratio
    EXPECT_NEAR(rows[1].p[0] / ratio, 1, 1e-6);
}

TEST(Work, IsCountedInUpdatesOfRows)
{
    std::vector<Response> bodies{cube(1, 0), cube(1, 0)};
    for (Response& body : bodies) {
        body.v = {0, 0, -1};
    }
    const std::vector<Vec3> centres{{0, 0, 0.5}, {0, 0, 1.5}};
    std::vector<Row> rows{contact(0, -1, {0, 0, 0}, centres, bodies),
                          contact(1, 0, {0, 0, 1}, centres, bodies)};
    SolverWork work;
    accelerated_sweeps(rows, bodies, work, {3, 0}); // halve the error, and so go on
    EXPECT_EQ(work.updates, 3 * 2);
    guess_states(rows, work);
    EXPECT_TRUE(solve_directly(rows, bodies, work));
    EXPECT_GT(work.updates, 6); // by less than an update for two unknowns
    EXPECT_LT(work.updates, 7);
}

} // namespace
} // namespace hyoryu
