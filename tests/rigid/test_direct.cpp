// SPDX-License-Identifier: MIT
// The direct solution of contact problems whose impulses are known in closed form.
#include "rigid/contact/solver.hpp"

#include <gtest/gtest.h>

namespace hyoryu::test_direct {
namespace {

Response cube(double mass, double inverse_moment)
{
    Response body;
    body.inverse_mass = Vec3::Constant(1 / mass);
    body.inverse_inertia = inverse_moment * Mat3::Identity();
    return body;
}

// A contact whose normal points up, on body a; b < 0 is the floor.
Row contact(int a, int b, const Vec3& point, const std::vector<Vec3>& centres,
            const std::vector<Response>& bodies, double friction = 0)
{
    Touch touch;
    touch.point = point;
    touch.normal = Vec3::UnitZ();
    const Vec3& xa = centres[static_cast<std::size_t>(a)];
    const Vec3& xb = b >= 0 ? centres[static_cast<std::size_t>(b)] : xa;
    Row row;
    row.a = a;
    row.b = b;
    row.cone.mu = friction;
    complete(row, {touch, touch}, {xa, xb, xa, xb}, bodies, 3);
    row.before = velocity(row, bodies);
    return row;
}

void solve(std::vector<Row>& rows, std::vector<Response>& bodies)
{
    SolverWork work;
    guess_states(rows, bodies, work);
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
        const double lever = 0.4 / (inverse_moment * 4 * half * half) * -row.turn_a(1, 0);
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

// A cube that lands sliding and spinning, each corner in another direction.
struct SpinningSlide {
    std::vector<Response> bodies{cube(2, 5)};
    std::vector<Row> rows;

    SpinningSlide()
    {
        bodies[0].v = {1, 0, -1};
        bodies[0].omega = {0, 0, 3};
        for (const double x : {-0.3, 0.3}) {
            for (const double y : {-0.3, 0.3}) {
                rows.push_back(contact(0, -1, {x, y, 0}, {{0, 0, 0.3}}, bodies, 0.2));
            }
        }
    }
};

TEST(Direct, DirectionsOfSlidingSettleByNewtonsMethod)
{
    SpinningSlide slide;
    gauss_seidel(slide.rows, slide.bodies, {3, 0});
    const double left = residual(slide.rows, slide.bodies);
    EXPECT_GT(left, 1e-3); // far from the solution
    solve(slide.rows, slide.bodies);
    // errors squared in each of four rounds are round-off; by a fixed point 7e-6 m/s was left
    EXPECT_LT(residual(slide.rows, slide.bodies), 1e-13);
    for (const Row& row : slide.rows) {
        const Vec3 u = velocity(row, slide.bodies);
        const Vec3 slip(0, u[1], u[2]);
        const Vec3 friction = -0.2 * row.p[0] * slip.normalized();
        EXPECT_NEAR((Vec3(0, row.p[1], row.p[2]) - friction).norm(), 0, 1e-13);
    }
}

// Three cubes on one another that stand still under their weights.
struct Pile {
    std::vector<Response> bodies{cube(1, 1), cube(1, 1), cube(1, 1)};
    std::vector<Row> rows;

    Pile()
    {
        const std::vector<Vec3> centres{{0, 0, 0.5}, {0, 0, 1.5}, {0, 0, 2.5}};
        for (Response& body : bodies) {
            body.v = {0, 0, -1e-2};
        }
        for (int k = 0; k < 3; ++k) {
            for (const double x : {-0.5, 0.5}) {
                for (const double y : {-0.5, 0.5}) {
                    rows.push_back(
                        contact(k, k - 1, {x, y, static_cast<double>(k)}, centres, bodies, 0.5));
                }
            }
        }
    }

    void push_all(double part)
    {
        for (std::size_t k = 0; k < rows.size(); ++k) {
            push(rows[k], Vec3(part * 1e-2 * static_cast<double>(3 - k / 4) / 4, 0, 0), bodies);
        }
    }
};

// Loads that change in every step leave known impulses that fit no more: the pile is solved all the
// same, as one of which nothing is known.
TEST(Solve, SolvesAPileWhoseKnownImpulsesAreOff)
{
    for (const double part : {0.0, 0.5, 0.9, 0.9999, 1.3}) {
        Pile pile;
        pile.push_all(part);
        SolverWork work;
        EXPECT_LE(solve(pile.rows, pile.bodies, work, {}),
                  1e-8); // a millionth of what is asked for
        for (const Response& body : pile.bodies) {
            EXPECT_LT(body.v.norm() + body.omega.norm(), 1e-8);
        }
    }
}

TEST(Solve, DropsKnownImpulsesThatAreWorseThanNone)
{
    const Effort rough{.enough = 1e-4, .direct_tries = 0, .sweeps = 60};
    Pile cold;
    Pile misled;
    misled.push_all(1e4); // the impulses of a blow
    SolverWork work;
    const double left = solve(cold.rows, cold.bodies, work, rough);
    EXPECT_NEAR(solve(misled.rows, misled.bodies, work, rough), left, 1e-12);
    for (std::size_t k = 0; k < cold.bodies.size(); ++k) {
        // round-off of the 100 m/s that the impulses led to
        EXPECT_LT((misled.bodies[k].v - cold.bodies[k].v).norm(), 1e-12);
    }
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
    guess_states(rows, bodies, work);
    EXPECT_TRUE(solve_directly(rows, bodies, work));
    EXPECT_GT(work.updates, 6); // by less than an update for two unknowns
    EXPECT_LT(work.updates, 7);
}

} // namespace
} // namespace hyoryu::test_direct
