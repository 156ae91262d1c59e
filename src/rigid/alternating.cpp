// SPDX-License-Identifier: MIT
// Alternating directions (ADMM) for one island: each step is one linear solution in the space of
// the bodies, which sees mass ratios and high piles at once, and one projection on each cone.
//
// With the impulses y, multipliers lambda, the velocities g(y) lifted by the De Saxce term, and
// R = diag(r_i):
//   x = y - (W + R)^-1 (g + lambda),  y <- P_K(x + lambda / R),  lambda <- lambda + R (x - y),
// at rest where g + lambda = 0 and y = P_K(y - g / R): the contact law, whatever W is used.
// Source: Carpentier, Le Lidec and Montaut (2024); Boyd et al. (2011) for the step and relaxation.
#include "solver.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// r_i as a part of the inverse mass of the contact; smaller ones let the De Saxce term swing.
constexpr double first_step = 1;
constexpr double relaxation = 1.6;
constexpr int steps_between_looks = 10; // at the balance of the two residuals
constexpr double imbalance = 10;        // beyond which the step is changed
constexpr double step_factor = 3;

Mat3 root_of_inertia(const Mat3& inverse_inertia)
{
    const Eigen::SelfAdjointEigenSolver<Mat3> modes(inverse_inertia);
    const Vec3 roots = modes.eigenvalues().cwiseMax(0.0).cwiseSqrt();
    return modes.eigenvectors() * roots.asDiagonal();
}

// J M^-1/2 of one body of a contact, in the axes of the row.
Eigen::Matrix<double, 3, 6> half_answer(const Mat3& D, const Mat3& C, const Response& body)
{
    Eigen::Matrix<double, 3, 6> H;
    H.leftCols<3>() = D.transpose() * body.inverse_mass.cwiseSqrt().asDiagonal();
    H.rightCols<3>() = C.transpose() * root_of_inertia(body.inverse_inertia);
    return H;
}

int place_of(const std::vector<int>& sorted, int body)
{
    const auto found = std::lower_bound(sorted.begin(), sorted.end(), body);
    return found != sorted.end() && *found == body ? static_cast<int>(found - sorted.begin()) : -1;
}

void set_links(std::span<const Row> rows, const std::vector<Response>& bodies, SolverWork& work)
{
    work.links.clear();
    for (const Row& row : rows) {
        Link link;
        link.a = place_of(work.island, row.a);
        link.b = row.b < 0 ? -1 : place_of(work.island, row.b);
        if (link.a >= 0) {
            link.Ha = half_answer(row.D, row.Ca, bodies[row.a]);
        }
        if (link.b >= 0) {
            link.Hb = -half_answer(row.D, row.Cb, bodies[row.b]);
        }
        link.Ha.bottomRows(3 - row.cone.size).setZero();
        link.Hb.bottomRows(3 - row.cone.size).setZero();
        link.inverse_mass = row.cone.K.diagonal().head(row.cone.size).mean();
        work.links.push_back(link);
    }
}

// The Cholesky factor of 1 + sum H^T H / r over the island.
void factorise(SolverWork& work, double step)
{
    const auto n = static_cast<Eigen::Index>(6 * work.island.size());
    work.W.setIdentity(n, n);
    for (Link& link : work.links) {
        link.r = step * link.inverse_mass;
        if (link.a >= 0) {
            work.W.block<6, 6>(6 * link.a, 6 * link.a) += link.Ha.transpose() * link.Ha / link.r;
        }
        if (link.b >= 0) {
            work.W.block<6, 6>(6 * link.b, 6 * link.b) += link.Hb.transpose() * link.Hb / link.r;
        }
        if (link.a >= 0 && link.b >= 0) {
            const Eigen::Matrix<double, 6, 6> both = link.Ha.transpose() * link.Hb / link.r;
            work.W.block<6, 6>(6 * link.a, 6 * link.b) += both;
            work.W.block<6, 6>(6 * link.b, 6 * link.a) += both.transpose();
        }
    }
    work.factor.compute(work.W);
}

// d = (W + R)^-1 q by the formula of Woodbury; q and d are in the links.
void solve_links(SolverWork& work)
{
    work.rhs.setZero(static_cast<Eigen::Index>(6 * work.island.size()));
    for (const Link& link : work.links) {
        if (link.a >= 0) {
            work.rhs.segment<6>(6 * link.a) += link.Ha.transpose() * link.q / link.r;
        }
        if (link.b >= 0) {
            work.rhs.segment<6>(6 * link.b) += link.Hb.transpose() * link.q / link.r;
        }
    }
    work.factor.solveInPlace(work.rhs);
    for (Link& link : work.links) {
        Vec3 d = link.q;
        if (link.a >= 0) {
            d -= link.Ha * work.rhs.segment<6>(6 * link.a);
        }
        if (link.b >= 0) {
            d -= link.Hb * work.rhs.segment<6>(6 * link.b);
        }
        link.q = d / link.r;
    }
}

// The velocity of a contact less its target, lifted by mu |u_t| (De Saxce and Feng 1998).
Vec3 lifted(const Row& row, const std::vector<Response>& bodies)
{
    Vec3 u = velocity(row, bodies);
    u.tail(3 - row.cone.size).setZero();
    u[0] += (row.cone.size > 1 ? row.cone.mu * u.tail<2>().norm() : 0) - row.target;
    return u;
}

struct Change {
    double primal = 0; // largest distance from the cones [m/s]
    double dual = 0;   // largest change of the impulses [m/s]
};

Change step_once(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work)
{
    for (std::size_t k = 0; k < rows.size(); ++k) {
        work.links[k].q = lifted(rows[k], bodies) + work.links[k].lambda;
    }
    solve_links(work);
    Change change;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        Row& row = rows[k];
        Link& link = work.links[k];
        const Vec3 x = row.p - relaxation * link.q;
        const Vec3 y = onto_cone(x + link.lambda / link.r, row.cone.mu, row.cone.size);
        link.lambda += link.r * (x - y);
        change.primal = std::max(change.primal, link.inverse_mass * (x - y).norm());
        change.dual = std::max(change.dual, link.r * (y - row.p).norm());
        push(row, y - row.p, bodies);
    }
    return change;
}

} // namespace

void alternating_directions(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work,
                            const Sweeps& steps)
{
    work.island.clear();
    for (const Row& row : rows) {
        for (const int body : {row.a, row.b}) {
            if (body >= 0 && bodies[body].movable) {
                work.island.push_back(body);
            }
        }
    }
    std::sort(work.island.begin(), work.island.end());
    work.island.erase(std::unique(work.island.begin(), work.island.end()), work.island.end());
    set_links(rows, bodies, work);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        work.links[k].lambda = -lifted(rows[k], bodies);
    }
    double step = first_step;
    factorise(work, step);
    for (int k = 1; k <= steps.most; ++k) {
        const Change change = step_once(rows, bodies, work);
        if (std::max(change.primal, change.dual) <= steps.settled) {
            return;
        }
        const bool stiffer = change.primal > imbalance * change.dual;
        const bool softer = change.dual > imbalance * change.primal;
        if (k % steps_between_looks == 0 && (stiffer || softer)) {
            step *= stiffer ? step_factor : 1 / step_factor;
            factorise(work, step);
        }
    }
}

} // namespace hyoryu
