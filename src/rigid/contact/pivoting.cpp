// SPDX-License-Identifier: MIT
// Frictionless contacts by block principal pivoting: finds the pressed rows of the linear
// complementarity problem W p + u_free - u* = w, p >= 0, w >= 0, p w = 0.
#include "solver.hpp"

#include <Eigen/Cholesky>

#include <algorithm>

namespace hyoryu {

namespace {

// Block exchanges allowed without reducing the number of wrong rows; then one row at a time.
constexpr int patience = 3;
// Murty's rule ends after finitely many exchanges; this limit per row stops it earlier.
constexpr std::size_t exchanges_per_row = 4;
// Tolerance of the targets, relative to the largest required change of velocity.
constexpr double met = 1e-9;

struct Complementarity {
    Eigen::MatrixXd W;       // velocities by impulses, shifted to be regular [1/kg]
    Eigen::VectorXd missing; // target less the velocity without impulses [m/s]
    Eigen::VectorXd p;       // [N s]
    std::vector<char> presses;
};

Complementarity without_impulses(std::span<Row> rows, std::vector<Response>& bodies, double shift)
{
    const auto n = static_cast<Index>(rows.size());
    const auto row = [&](Index k) -> Row& { return rows[k]; };
    set_impulses(rows, std::vector<Vec3>(rows.size(), Vec3::Zero()), bodies);
    Complementarity c{Eigen::MatrixXd(n, n), Eigen::VectorXd(n), Eigen::VectorXd::Zero(n),
                      std::vector<char>(rows.size(), 0)};
    Eigen::VectorXd free(n);
    for (Index k = 0; k < n; ++k) {
        free[k] = velocity(row(k), bodies)[0];
        c.missing[k] = row(k).target - free[k];
    }
    for (Index j = 0; j < n; ++j) {
        push(row(j), Vec3(1, 0, 0), bodies);
        for (Index i = 0; i < n; ++i) {
            c.W(i, j) = velocity(row(i), bodies)[0] - free[i];
        }
        push(row(j), Vec3(-1, 0, 0), bodies);
    }
    c.W.diagonal() *= 1 + shift; // relative to each row, so that heavy bodies yield little
    return c;
}

// Solves for the impulses of the pressed rows such that these meet their targets.
void solve_pressing(Complementarity& c)
{
    std::vector<Index> pressing;
    for (std::size_t k = 0; k < c.presses.size(); ++k) {
        if (c.presses[k] != 0) {
            pressing.push_back(static_cast<Index>(k));
        }
    }
    const Eigen::VectorXd part = c.W(pressing, pressing).ldlt().solve(c.missing(pressing).eval());
    c.p.setZero();
    c.p(pressing) = part;
}

std::vector<std::size_t> wrong_rows(const Complementarity& c)
{
    const double enough = met * c.missing.lpNorm<Eigen::Infinity>();
    const Eigen::VectorXd w = c.W * c.p - c.missing;
    std::vector<std::size_t> wrong;
    for (std::size_t k = 0; k < c.presses.size(); ++k) {
        const auto i = static_cast<Index>(k);
        if (c.presses[k] != 0 ? c.p[i] < 0 : w[i] < -enough) {
            wrong.push_back(k);
        }
    }
    return wrong;
}

void find_pressing(Complementarity& c)
{
    std::size_t fewest = c.presses.size() + 1;
    int left = patience;
    const std::size_t most = exchanges_per_row * c.presses.size();
    for (std::size_t exchange = 0; exchange < most; ++exchange) {
        std::vector<std::size_t> wrong = wrong_rows(c);
        if (wrong.empty()) {
            return;
        }
        if (wrong.size() < fewest) {
            fewest = wrong.size();
            left = patience;
        } else if (left > 0) {
            --left;
        } else {
            wrong.erase(wrong.begin(), wrong.end() - 1); // Murty's rule: the last of them
        }
        for (const std::size_t k : wrong) {
            c.presses[k] = c.presses[k] != 0 ? 0 : 1;
        }
        solve_pressing(c);
    }
}

} // namespace

double solve_by_pivoting(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work)
{
    const double left = residual(rows, bodies);
    return left_by(rows, bodies, work, left, left, [&] {
        Complementarity c = without_impulses(rows, bodies, work.shift);
        find_pressing(c);
        std::vector<Vec3> p;
        for (const double p_n : c.p) {
            p.emplace_back(std::max(p_n, 0.0), 0, 0);
        }
        set_impulses(rows, p, bodies);
    });
}

} // namespace hyoryu
