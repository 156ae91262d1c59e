// SPDX-License-Identifier: MIT
// The linear problem of many contacts, solved for the velocities of their bodies: W = G A, where A
// maps impulses to velocities of the bodies and G these to velocities at the contacts, so that
// (G A + S)^-1 = S^-1 (1 - G (1 + A S^-1 G)^-1 A S^-1) for a diagonal S (Woodbury). The matrix in
// the middle couples only bodies that touch, with six rows for each body: its elimination costs
// O(n) for a stack of n bodies, that of W O(n^3).
#include "solver.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// Shift of each contact relative to its own inverse mass, so that it is effective at any mass
// ratio.
constexpr double shift = 1e-8;
// Most corrections; each reduces the error to the part shift / (shift + eigenvalue).
constexpr int corrections = 20;
// Residuals relative to the right-hand side: at which corrections end, and which is still accepted.
constexpr double corrected = 1e-13;
constexpr double acceptable = 1e-9;
// Corrections end if one of them leaves more than this part of the residual.
constexpr double progress = 0.9;
// Cost of one product of two 6 x 6 blocks, in updates of rows.
constexpr double updates_of_product = 0.5;

int place_of(const BlockWork& work, int body)
{
    return body >= 0 ? work.place[body] : -1;
}

// Numbers the movable bodies.
void number_bodies(std::span<const Row> rows, const std::vector<Response>& bodies, BlockWork& work)
{
    work.place.resize(bodies.size(), -1);
    for (const int body : work.members) {
        work.place[body] = -1;
    }
    work.members.clear();
    for (const Row& row : rows) {
        for (const int body : {row.a, row.b}) {
            if (body >= 0 && bodies[body].movable && place_of(work, body) < 0) {
                work.place[body] = static_cast<int>(work.members.size());
                work.members.push_back(body);
            }
        }
    }
}

// Sets the rows of the problem, with bodies by their place in the elimination.
void lay_out(std::span<const Row> rows, SolverWork& work)
{
    BlockWork& blocks = work.blocks;
    blocks.ends.clear();
    blocks.shifts.clear();
    blocks.yields.assign(work.unknowns.size(), 0);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const Row& row = rows[k];
        const double inverse_mass = row.cone.K.diagonal().maxCoeff();
        for (int m = work.columns[k]; m < work.columns[k + 1]; ++m) {
            blocks.ends.emplace_back(place_of(blocks, row.a), place_of(blocks, row.b));
            blocks.shifts.push_back(shift * inverse_mass);
        }
        if (work.across[k] >= 0) { // partly sticking
            const auto m = static_cast<std::size_t>(work.across[k]);
            work.unknowns[m].jacobian_a *= work.held[k];
            work.unknowns[m].jacobian_b *= work.held[k];
            blocks.yields[m] = (1 - work.held[k]) * row.cone.K(1, 1);
        }
    }
}

void assemble(SolverWork& work)
{
    BlockWork& blocks = work.blocks;
    set_identity(blocks.matrix);
    for (std::size_t m = 0; m < work.unknowns.size(); ++m) {
        const Unknown& unknown = work.unknowns[m];
        const double part = 1 / (blocks.shifts[m] + blocks.yields[m]);
        const auto [a, b] = blocks.ends[m];
        const auto add = [&](int i, int j, const Vec6& answer, const Vec6& sight) {
            if (i >= 0 && j >= 0) {
                blocks.matrix.at(i, j).noalias() += (part * answer) * sight.transpose();
            }
        };
        add(a, a, unknown.response_a, unknown.jacobian_a);
        add(a, b, unknown.response_a, unknown.jacobian_b);
        add(b, a, unknown.response_b, unknown.jacobian_a);
        add(b, b, unknown.response_b, unknown.jacobian_b);
    }
}

// The velocities due to impulses: A x.
void answer(const SolverWork& work, const Eigen::VectorXd& x, std::vector<Vec6>& velocities)
{
    velocities.assign(work.blocks.members.size(), Vec6::Zero());
    for (std::size_t m = 0; m < work.unknowns.size(); ++m) {
        const auto [a, b] = work.blocks.ends[m];
        const double p = x[static_cast<Index>(m)];
        if (a >= 0) {
            velocities[a] += p * work.unknowns[m].response_a;
        }
        if (b >= 0) {
            velocities[b] += p * work.unknowns[m].response_b;
        }
    }
}

// Row m of G v: the contact velocity in equation m.
double seen(const SolverWork& work, std::size_t m, const std::vector<Vec6>& velocities)
{
    const auto [a, b] = work.blocks.ends[m];
    double u = 0;
    u += a >= 0 ? work.unknowns[m].jacobian_a.dot(velocities[a]) : 0;
    u += b >= 0 ? work.unknowns[m].jacobian_b.dot(velocities[b]) : 0;
    return u;
}

// Adds the solution of the shifted problem for the residual.
void correct(SolverWork& work)
{
    BlockWork& blocks = work.blocks;
    const std::size_t n = work.unknowns.size();
    for (std::size_t m = 0; m < n; ++m) {
        work.left_over[static_cast<Index>(m)] /= blocks.shifts[m] + blocks.yields[m];
    }
    answer(work, work.left_over, blocks.velocities);
    solve(blocks.matrix, blocks.velocities);
    for (std::size_t m = 0; m < n; ++m) {
        const double u = seen(work, m, blocks.velocities);
        work.solution[static_cast<Index>(m)] +=
            work.left_over[static_cast<Index>(m)] - u / (blocks.shifts[m] + blocks.yields[m]);
    }
}

// Computes the residual and returns its maximum norm.
double find_left_over(SolverWork& work)
{
    BlockWork& blocks = work.blocks;
    answer(work, work.solution, blocks.velocities);
    for (std::size_t m = 0; m < work.unknowns.size(); ++m) {
        const auto k = static_cast<Index>(m);
        work.left_over[k] =
            work.rhs[k] - seen(work, m, blocks.velocities) - blocks.yields[m] * work.solution[k];
    }
    return work.left_over.lpNorm<Eigen::Infinity>();
}

} // namespace

void order_bodies(std::span<const Row> rows, const std::vector<Response>& bodies, SolverWork& work)
{
    BlockWork& blocks = work.blocks;
    number_bodies(rows, bodies, blocks);
    blocks.pairs.clear();
    for (const Row& row : rows) {
        const int a = place_of(blocks, row.a);
        const int b = place_of(blocks, row.b);
        if (a >= 0 && b >= 0) {
            blocks.pairs.emplace_back(std::min(a, b), std::max(a, b));
        }
    }
    std::ranges::sort(blocks.pairs);
    const auto same = std::ranges::unique(blocks.pairs);
    blocks.pairs.erase(same.begin(), same.end());
    order(blocks.matrix, static_cast<int>(blocks.members.size()), blocks.pairs);
    for (const int body : blocks.members) {
        int& place = blocks.place[body];
        place = blocks.matrix.step_of[place];
    }
}

bool solve_by_bodies(std::span<const Row> rows, SolverWork& work)
{
    lay_out(rows, work);
    assemble(work);
    factorise(work.blocks.matrix);
    work.updates += updates_of_product * work.blocks.matrix.products;
    work.solution.setZero(static_cast<Index>(work.unknowns.size()));
    work.left_over = work.rhs;
    const double most = work.rhs.lpNorm<Eigen::Infinity>();
    double left = most;
    for (int k = 0; k < corrections && left > corrected * most; ++k) {
        const double last = left;
        correct(work);
        left = find_left_over(work);
        work.updates += static_cast<double>(rows.size());
        if (!(left < progress * last)) {
            break;
        }
    }
    return left <= acceptable * most;
}

} // namespace hyoryu
