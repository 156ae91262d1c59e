// SPDX-License-Identifier: MIT
// Gauss-Seidel sweeps with exact local solutions, plain and with momentum.
#include "solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hyoryu {

namespace {

using LocalSolution = ConeImpulse (*)(const Cone&, const Vec3&, const Vec3&);

double change_of(Row& row, std::vector<Response>& bodies, LocalSolution solution)
{
    Vec3 b = velocity(row, bodies) - row.cone.K * row.p;
    b[0] -= row.target;
    const ConeImpulse best = solution(row.cone, b, row.p);
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

// The bodies that the rows move, and where the sequence starts.
void remember_start(std::span<const Row> rows, const std::vector<Response>& bodies,
                    SolverWork& work)
{
    work.impulses.clear();
    work.moved.clear();
    for (const Row& row : rows) {
        work.impulses.push_back(row.p);
        for (const int body : {row.a, row.b}) {
            if (body >= 0 && bodies[body].movable) {
                work.moved.push_back(body);
            }
        }
    }
    std::ranges::sort(work.moved);
    work.moved.erase(std::ranges::unique(work.moved).begin(), work.moved.end());
    work.velocities.clear();
    for (const int body : work.moved) {
        work.velocities.push_back({bodies[body].v, bodies[body].omega});
    }
    work.start = work.impulses;
    work.changes.resize(rows.size());
}

// Whether the last sweep opposes the momentum step (gradient criterion of the restart).
bool leads_uphill(std::span<const Row> rows, const SolverWork& work)
{
    double uphill = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        uphill += (rows[k].cone.K * (work.start[k] - rows[k].p)).dot(rows[k].p - work.impulses[k]);
    }
    return uphill > 0;
}

// Extrapolates by `beta` times the last change. Velocities are linear in the impulses, so that
// those of the bodies can be extrapolated directly.
void add_momentum(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work, double beta)
{
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const Vec3 solved = rows[k].p;
        rows[k].p += beta * (solved - work.impulses[k]);
        work.impulses[k] = solved;
        work.start[k] = rows[k].p;
    }
    for (std::size_t k = 0; k < work.moved.size(); ++k) {
        Response& body = bodies[work.moved[k]];
        const Twist solved{body.v, body.omega};
        body.v += beta * (solved.v - work.velocities[k].v);
        body.omega += beta * (solved.omega - work.velocities[k].omega);
        work.velocities[k] = solved;
    }
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
        for (std::size_t k = 0; k < n; ++k) { // alternating direction for symmetry
            Row& row = rows[sweep % 2 == 0 ? k : n - 1 - k];
            change = std::max(change, change_of(row, bodies, cone_impulse));
        }
    }
    return change;
}

double accelerated_sweeps(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work,
                          const Sweeps& sweeps)
{
    sort_by_colour(rows, bodies, work.colours);
    remember_start(rows, bodies, work);
    double theta = 1;
    double change = infinity;
    for (int sweep = 1; sweep <= sweeps.most && change > sweeps.settled; ++sweep) {
        work.updates += static_cast<double>(rows.size());
        for_each_row(work.colours, [&](std::size_t k) {
            work.changes[k] = change_of(rows[k], bodies, nearer_impulse);
        });
        const double last = std::exchange(change, *std::ranges::max_element(work.changes));
        // Friction is not the gradient of a function: momentum that overshoots or diverges is
        // reset.
        const bool astray = change > last || leads_uphill(rows, work);
        const double next = next_theta(theta);
        const bool goes_on = sweep < sweeps.most && change > sweeps.settled && !astray;
        add_momentum(rows, bodies, work, goes_on ? theta * (1 - theta) / (sq(theta) + next) : 0);
        theta = astray ? 1 : next;
    }
    return change;
}

} // namespace hyoryu
