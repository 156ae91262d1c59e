// SPDX-License-Identifier: MIT
// Gauss-Seidel sweeps with exact local solutions, plain and with momentum.
#include "solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hyoryu {

namespace {

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

// The sequence of Nesterov (1983): theta of the next step, from 1.
double next_theta(double theta)
{
    const double square = sq(theta);
    return 0.5 * (std::sqrt(sq(square) + 4 * square) - square);
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

double gauss_seidel(std::span<Row> rows, std::vector<Response>& bodies, const Sweeps& sweeps)
{
    const std::size_t n = rows.size();
    double change = infinity;
    for (int sweep = 0; sweep < sweeps.most && change > sweeps.settled; ++sweep) {
        change = 0;
        for (std::size_t k = 0; k < n; ++k) { // to and fro, so that no end is favoured
            Row& row = rows[sweep % 2 == 0 ? k : n - 1 - k];
            change = std::max(change, change_of(row, bodies));
        }
    }
    return change;
}

double accelerated_sweeps(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work,
                          const Sweeps& sweeps)
{
    sort_by_colour(rows, bodies, work.colours);
    const std::size_t n = rows.size();
    std::vector<Vec3>& previous = work.impulses; // after the last sweep
    std::vector<Vec3>& start = work.start;       // of this sweep, momentum included
    previous.resize(n);
    work.changes.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
        previous[k] = rows[k].p;
    }
    start = previous;
    double theta = 1;
    double change = infinity;
    for (int sweep = 1; sweep <= sweeps.most && change > sweeps.settled; ++sweep) {
        for_each_row(work.colours,
                     [&](std::size_t k) { work.changes[k] = change_of(rows[k], bodies); });
        const double last = std::exchange(change, *std::ranges::max_element(work.changes));
        double uphill = 0;
        for (std::size_t k = 0; k < n; ++k) {
            uphill += (rows[k].cone.K * (start[k] - rows[k].p)).dot(rows[k].p - previous[k]);
        }
        // Friction is no gradient: momentum that carries past the solution, or away from it, ends.
        const bool astray = uphill > 0 || change > last;
        const double next = next_theta(theta);
        const double beta = astray ? 0 : theta * (1 - theta) / (sq(theta) + next);
        theta = astray ? 1 : next;
        const bool goes_on = sweep < sweeps.most && change > sweeps.settled;
        for_each_row(work.colours, [&](std::size_t k) {
            const Vec3 solved = rows[k].p;
            if (goes_on) {
                push(rows[k], beta * (solved - previous[k]), bodies);
            }
            previous[k] = solved;
            start[k] = rows[k].p;
        });
    }
    return change;
}

} // namespace hyoryu
