// SPDX-License-Identifier: MIT
// Accelerated projected gradient for large or ill-conditioned piles.
#include "solver.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

constexpr int power_steps = 12; // enough for a bound within the safety factor
constexpr double safety = 1.3;

// Scaling a contact by one number keeps its cone and evens out mass ratios.
double scale_of(const Row& row)
{
    return 1 / std::sqrt(row.cone.K.trace());
}

void set_impulse(Row& row, const Vec3& p, std::vector<Response>& bodies)
{
    push(row, p - row.p, bodies);
}

// The largest eigenvalue of the scaled problem, by powers of it.
double stiffness(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work)
{
    const std::size_t n = rows.size();
    std::vector<Vec3> start;
    for (Row& row : rows) {
        start.push_back(row.p);
        set_impulse(row, Vec3::Zero(), bodies);
    }
    work.momenta.clear();
    for (const Row& row : rows) {
        work.momenta.push_back(velocity(row, bodies));
    }
    std::vector<Vec3> x(n, Vec3(1, 0.5, 0.25));
    double largest = 1;
    for (int step = 0; step < power_steps; ++step) {
        double norm2 = 0;
        for (const Vec3& v : x) {
            norm2 += v.squaredNorm();
        }
        for (std::size_t k = 0; k < n; ++k) {
            set_impulse(rows[k], scale_of(rows[k]) / std::sqrt(norm2) * x[k], bodies);
        }
        largest = 0;
        for (std::size_t k = 0; k < n; ++k) {
            x[k] = scale_of(rows[k]) * (velocity(rows[k], bodies) - work.momenta[k]);
            largest += x[k].squaredNorm();
        }
        largest = std::sqrt(largest);
    }
    for (std::size_t k = 0; k < n; ++k) {
        set_impulse(rows[k], start[k], bodies);
    }
    return safety * std::max(largest, 1.0);
}

struct Pace {
    double L = 1; // bound of the curvature
    int steps = 0;
};

// One pass with the De Saxce term mu |u_t| held fixed.
void accelerated_pass(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work,
                      const Pace& pace)
{
    const std::size_t n = rows.size();
    std::vector<double> lift(n);
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3 u = velocity(rows[k], bodies);
        const double u2 = rows[k].cone.size == 3 ? u[2] : 0;
        lift[k] = rows[k].cone.size == 1 ? 0 : rows[k].cone.mu * std::hypot(u[1], u2);
    }
    work.impulses.resize(n);
    std::vector<Vec3> previous(n);
    std::vector<Vec3> gradient(n);
    for (std::size_t k = 0; k < n; ++k) {
        previous[k] = rows[k].p / scale_of(rows[k]);
        work.impulses[k] = previous[k];
    }
    double theta = 1;
    for (int step = 0; step < pace.steps; ++step) {
        for (std::size_t k = 0; k < n; ++k) {
            set_impulse(rows[k], scale_of(rows[k]) * work.impulses[k], bodies);
        }
        double uphill = 0;
        double moved = 0;
        for (std::size_t k = 0; k < n; ++k) {
            Vec3 u = velocity(rows[k], bodies);
            u[0] += lift[k] - rows[k].target;
            gradient[k] = scale_of(rows[k]) * u;
        }
        const double theta_next = 0.5 * (std::sqrt(sq(sq(theta)) + 4 * sq(theta)) - sq(theta));
        const double beta = theta * (1 - theta) / (sq(theta) + theta_next);
        for (std::size_t k = 0; k < n; ++k) {
            const Vec3 next = onto_cone(work.impulses[k] - gradient[k] / pace.L, rows[k].cone.mu,
                                        rows[k].cone.size);
            uphill += gradient[k].dot(next - previous[k]);
            moved = std::max(moved, (next - work.impulses[k]).norm() / scale_of(rows[k]));
            work.impulses[k] = next + beta * (next - previous[k]);
            previous[k] = next;
        }
        theta = theta_next;
        if (uphill > 0) { // restart: the momentum carries past the minimum
            theta = 1;
            work.impulses = previous;
        }
        if (moved * pace.L < solved_speed) {
            break;
        }
    }
    for (std::size_t k = 0; k < n; ++k) {
        set_impulse(rows[k], scale_of(rows[k]) * previous[k], bodies);
    }
}

} // namespace

// Each pass renews the De Saxce correction, which settles like mu^k.
void projected_gradient(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work,
                        const Effort& effort)
{
    const double L = stiffness(rows, bodies, work);
    for (int pass = 0; pass < effort.gradient_passes; ++pass) {
        accelerated_pass(rows, bodies, work, {L, effort.gradient_steps});
    }
}

} // namespace hyoryu
