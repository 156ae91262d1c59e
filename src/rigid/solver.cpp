// SPDX-License-Identifier: MIT
#include "solver.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Contacts up to which one body is left to Gauss-Seidel, which settles there in a few sweeps.
constexpr std::size_t few_contacts = 8;
constexpr int few_sweeps = 60;
constexpr int many_sweeps = 100; // hard cap; what remains is reported
// What sweeps may leave before the gradient method is called in [m/s]: a creep of a tenth of a
// micrometre per second.
constexpr double good_enough = 1e-7;
// Unknowns above which a dense direct solution costs more than the iteration.
constexpr std::size_t dense_contacts = 100;

bool one_body(std::span<const Row> rows, const std::vector<Response>& bodies)
{
    return std::all_of(rows.begin(), rows.end(), [&](const Row& row) {
        return row.a == rows[0].a && (row.b < 0 || !bodies[row.b].movable);
    });
}

void set_impulses(std::span<Row> rows, const std::vector<Vec3>& p, std::vector<Response>& bodies)
{
    for (std::size_t k = 0; k < rows.size(); ++k) {
        push(rows[k], p[k] - rows[k].p, bodies);
    }
}

double change_of(Row& row, std::vector<Response>& bodies)
{
    Vec3 b = velocity(row, bodies) - row.cone.K * row.p;
    b[0] -= row.target;
    const ConeImpulse best = cone_impulse(row.cone, b, row.p);
    row.tangential = best.tangential;
    const Vec3 dp = best.p - row.p;
    push(row, dp, bodies);
    return (row.cone.K * dp).cwiseAbs().maxCoeff();
}

} // namespace

double residual(std::span<Row> rows, const std::vector<Response>& bodies)
{
    double worst = 0;
    for (const Row& row : rows) {
        Vec3 b = velocity(row, bodies) - row.cone.K * row.p;
        b[0] -= row.target;
        const Vec3 dp = cone_impulse(row.cone, b, row.p).p - row.p;
        worst = std::max(worst, (row.cone.K * dp).cwiseAbs().maxCoeff());
    }
    return worst;
}

double gauss_seidel(std::span<Row> rows, std::vector<Response>& bodies, int sweeps)
{
    const std::size_t n = rows.size();
    double change = infinity;
    for (int sweep = 0; sweep < sweeps && change > settled_speed; ++sweep) {
        change = 0;
        for (std::size_t k = 0; k < n; ++k) { // to and fro, so that no end is favoured
            Row& row = rows[sweep % 2 == 0 ? k : n - 1 - k];
            change = std::max(change, change_of(row, bodies));
        }
    }
    return change;
}

double solve(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work)
{
    if (rows.size() == 1) {
        change_of(rows[0], bodies);
        return 0;
    }
    if (rows.size() <= few_contacts && one_body(rows, bodies)) {
        const double change = gauss_seidel(rows, bodies, few_sweeps);
        if (change <= solved_speed) {
            return change;
        }
    }
    double left = residual(rows, bodies);
    if (left <= solved_speed) {
        return left;
    }
    if (rows.size() <= dense_contacts) {
        work.start.clear();
        for (const Row& row : rows) {
            work.start.push_back(row.p);
        }
        solve_directly(rows, bodies, work);
        const double left_directly = residual(rows, bodies);
        if (left_directly <= 10 * solved_speed) { // round-off of an ill-conditioned stack
            return left_directly;
        }
        if (left_directly > left) {
            set_impulses(rows, work.start, bodies);
        }
    }
    left = gauss_seidel(rows, bodies, many_sweeps);
    if (left > good_enough) {
        projected_gradient(rows, bodies, work);
        left = gauss_seidel(rows, bodies, many_sweeps);
    }
    return left;
}

} // namespace hyoryu
