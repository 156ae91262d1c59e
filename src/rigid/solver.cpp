// SPDX-License-Identifier: MIT
#include "solver.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Contacts up to which one body is left to Gauss-Seidel, which settles there in a few sweeps.
constexpr std::size_t few_contacts = 24;
constexpr int few_sweeps = 60;
constexpr int sweeps_at_once = 20;
// More than this part left means that sweeps stall, as they do in high piles and at mass ratios.
constexpr double far_from_solved = 1e-3;
// Contacts above which a dense direct solution costs more than the iteration.
constexpr std::size_t dense_contacts = 60;

bool one_body(std::span<const Row> rows, const std::vector<Response>& bodies)
{
    return std::all_of(rows.begin(), rows.end(), [&](const Row& row) {
        return row.a == rows[0].a && (row.b < 0 || !bodies[row.b].movable);
    });
}

// The largest change of speed that the contacts are asked for.
double change_asked(std::span<const Row> rows)
{
    double most = 0;
    for (const Row& row : rows) {
        most = std::max(most, (row.before - Vec3(row.target, 0, 0)).norm());
    }
    return most;
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

namespace {

// Tries the direct solution; goes back if it is worse than what there was.
double try_directly(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work,
                    double left)
{
    work.start.clear();
    for (const Row& row : rows) {
        work.start.push_back(row.p);
    }
    guess_states(rows, work);
    solve_directly(rows, bodies, work);
    const double left_directly = residual(rows, bodies);
    if (left_directly <= left) {
        return left_directly;
    }
    set_impulses(rows, work.start, bodies);
    return left;
}

struct Task {
    const Effort& effort;
    double asked = 0;  // change of speed [m/s]
    double enough = 0; // of it that may be left [m/s]
};

// Direct solutions and alternating directions take turns: the iteration finds which contacts stick,
// slide and open, which the direct solution takes up (Silcowitz, Niebe and Erleben 2010).
double solve_small(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work,
                   const Task& task)
{
    double left = residual(rows, bodies);
    for (int k = 0; k <= task.effort.direct_tries && left > task.enough; ++k) {
        left = k < task.effort.direct_tries ? try_directly(rows, bodies, work, left) : left;
        if (left > task.enough) {
            alternating_directions(rows, bodies, work, {task.effort.alternations, task.enough});
            left = residual(rows, bodies);
        }
    }
    return left;
}

// Sweeps, and the gradient method where they stall.
double solve_large(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work,
                   const Task& task)
{
    const Sweeps sweeps{sweeps_at_once, task.enough};
    double left = gauss_seidel(rows, bodies, sweeps);
    if (task.effort.gradient_passes > 0 && left > far_from_solved * task.asked) {
        projected_gradient(rows, bodies, work, task.effort);
        left = gauss_seidel(rows, bodies, sweeps);
    }
    return left;
}

} // namespace

double solve(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work,
             const Effort& effort)
{
    if (rows.size() == 1) {
        change_of(rows[0], bodies);
        return 0;
    }
    const bool alone = rows.size() <= few_contacts && one_body(rows, bodies);
    if (alone) {
        const double change = gauss_seidel(rows, bodies, {few_sweeps, settled_speed});
        if (change <= solved_speed) {
            return change;
        }
    }
    double left = residual(rows, bodies);
    if (left <= solved_speed) {
        return left;
    }
    const double asked = change_asked(rows);
    const double enough = alone ? solved_speed : std::max(effort.enough * asked, solved_speed);
    if (cold(rows)) {
        left = gauss_seidel(rows, bodies, {sweeps_at_once, enough});
    }
    if (rows.size() > dense_contacts) {
        return left > enough ? solve_large(rows, bodies, work, {effort, asked, enough}) : left;
    }
    return left > enough ? solve_small(rows, bodies, work, {effort, asked, enough}) : left;
}

} // namespace hyoryu
