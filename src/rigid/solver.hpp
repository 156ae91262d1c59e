// SPDX-License-Identifier: MIT
// The impulses of many contacts at once.
#pragma once

#include "row.hpp"

#include <span>

namespace hyoryu {

/// Scratch of the solvers, kept between calls.
struct SolverWork {
    Eigen::MatrixXd W;
    Eigen::VectorXd rhs;
    Eigen::VectorXd solution;
    std::vector<Response> before;
    std::vector<int> states;
    std::vector<int> columns;
    std::vector<Vec3> directions, impulses, momenta, start;
};

/// Solves normal velocity >= target, impulse >= 0, Coulomb friction for all rows together, from the
/// impulses the rows hold (already applied to the bodies). Returns the largest speed by which a
/// contact still wants to change [m/s]. A row that met a Painleve configuration has `tangential`
/// set.
///
/// One body and few contacts: Gauss-Seidel with exact local solutions. Otherwise first the
/// active-set direct solution (all stick, then with sliding and open contacts set aside), which is
/// blind to mass ratios; if that does not settle, accelerated projected gradient (Mazhar et al.
/// 2015) with the De Saxce correction for sliding, and Gauss-Seidel to polish.
double solve(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work);

/// The parts of the solver, for its tests and for one another.
double residual(std::span<Row> rows, const std::vector<Response>& bodies);
double gauss_seidel(std::span<Row> rows, std::vector<Response>& bodies, int sweeps);
bool solve_directly(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work);
void projected_gradient(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work);

/// The speed by which a solved problem may still want to change [m/s]: g h of a step of a
/// microsecond is a million times more.
inline constexpr double solved_speed = 1e-11;
/// The speed at which sweeps stop, the round-off of metres per second: errors of many impacts add
/// up.
inline constexpr double settled_speed = 1e-13;

} // namespace hyoryu
