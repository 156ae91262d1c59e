// SPDX-License-Identifier: MIT
// Solvers for the impulses of many contacts: active sets, pivoting and accelerated Gauss-Seidel.
#pragma once

#include "block_matrix.hpp"
#include "colours.hpp"

#include <Eigen/LU>

#include <limits>
#include <span>

namespace hyoryu {

/// An unknown impulse of the direct solution: the velocities (v, omega) that a unit impulse gives
/// to the two bodies (the responses), and the coefficients of their velocities in its equation (the
/// Jacobians).
struct Unknown {
    Vec6 response_a, response_b, jacobian_a, jacobian_b;
};

/// Scratch of the direct solution by bodies.
struct BlockWork {
    std::vector<int> members;               // bodies that move
    std::vector<int> place;                 // of each body in the elimination; -1: it does not move
    std::vector<std::pair<int, int>> pairs; // of members that touch
    std::vector<std::pair<int, int>> ends;  // of each unknown: places of its bodies
    std::vector<double> shifts, yields;     // of each unknown: on the diagonal of W [1/kg]
    std::vector<Vec6> velocities;           // by place
    BlockMatrix matrix;
};

/// Diagonal shifts that make the matrix regular: the small one for piles, which are
/// ill-conditioned, the large one for the few contacts of a face, whose load it distributes to
/// eleven digits.
inline constexpr double small_shift = 1e-8;
inline constexpr double large_shift = 1e-5;

/// Problems with more contacts are solved for the velocities of their bodies.
inline constexpr int dense_contacts = 8;
/// The matrix of at most `dense_contacts` contacts, stored without heap allocation.
using DenseMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                  3 * dense_contacts, 3 * dense_contacts>;

/// Scratch of the solvers, kept between calls.
struct SolverWork {
    Eigen::PartialPivLU<DenseMatrix> factor;
    DenseMatrix W;
    Eigen::VectorXd rhs;
    Eigen::VectorXd solution;
    Eigen::VectorXd left_over;
    std::vector<int> states;
    std::vector<int> columns; // first unknown of each row, and the end
    std::vector<int> across;  // the unknown of each row across its direction of sliding; -1: none
    std::vector<Unknown> unknowns;
    std::vector<Vec3> directions, momenta, base;
    std::vector<double> held; // held part across each sliding direction [1]
    BlockWork blocks;
    Colours colours;
    std::vector<double> shares;    // contribution of each known impulse [J]
    std::vector<double> changes;   // of each row in a sweep [m/s]
    std::vector<Vec3> start;       // impulses at the start of the sweep, with momentum
    std::vector<Vec3> impulses;    // after the last sweep
    std::vector<int> moved;        // movable bodies, sorted
    std::vector<Twist> velocities; // their velocities after the last sweep
    double unit = 1;               // scale of the speed tolerances [m/s]
    // Shift of the diagonal that makes the direct problem regular, relative to its largest entry.
    // The relative error of the load of redundant contacts is the machine precision over this
    // shift.
    double shift = small_shift;
    double updates = 0; // of rows, since this was set to zero: what solves cost, on any machine
    /// Half of the required change of velocity is left: no impulses keep all contacts apart, for
    /// instance if two walls press a body from both sides.
    bool unsolved = false;
};

/// Islands with more contacts are piles. Nine in ten direct solutions of piles with many impacts do
/// not converge, and other errors exceed those of contacts that stop sliding or of bodies that turn
/// on their contacts within a sub-step.
inline constexpr std::size_t contacts_of_a_pile = 8;

/// Limits on the cost and the residual of a solution.
struct Effort {
    /// Allowed residual relative to the largest required change of velocity [1].
    double enough = 1e-6;
    int direct_tries = 2; // direct solutions of a small island, each before sweeps
    int sweeps = 300;     // in each turn
    /// Work limit of a turn [updates of rows]: many rows get fewer sweeps, down to a fixed number.
    std::size_t updates = 2000;
    /// Rows of an island without friction up to which it is solved by pivoting.
    std::size_t pivoted = 0;
    /// Rows of an island without impulses from which on it is first solved for as if all of them
    /// stuck: a pile at rest. Blows seldom leave one.
    std::size_t stuck = std::numeric_limits<std::size_t>::max();
};

/// Solves normal velocity >= target, impulse >= 0, Coulomb friction for all rows together, from the
/// impulses the rows hold (already applied to the bodies). Returns the largest speed by which a
/// contact still wants to change [m/s]. A row that met a Painleve configuration
/// has `tangential` set.
///
/// One body and few contacts: Gauss-Seidel with exact local solutions. Otherwise the active-set
/// direct solution (Newton's method, to the square of what it was off in each round), which is
/// blind to mass ratios, in turns with accelerated Gauss-Seidel sweeps. Islands too large for that:
/// the sweeps alone.
double solve(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work,
             const Effort& effort);

/// The parts of the solver, for its tests and for one another.
double residual(std::span<Row> rows, const std::vector<Response>& bodies);
/// What `attempt` leaves, if that is at most `most`; else puts the impulses back that the rows had
/// and returns `otherwise` [m/s]. The attempt must leave `work.start` as it is.
double left_by(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work, double most,
               double otherwise, const auto& attempt)
{
    work.start.clear();
    for (const Row& row : rows) {
        work.start.push_back(row.p);
    }
    attempt();
    const double left = residual(rows, bodies);
    if (left <= most) {
        return left;
    }
    set_impulses(rows, work.start, bodies);
    return otherwise;
}
struct Sweeps {
    int most = 0;
    double settled = 0; // change of speed in a sweep at which to stop [m/s]
};
double gauss_seidel(std::span<Row> rows, std::vector<Response>& bodies, const Sweeps& sweeps);
/// Whether no impulse is known yet.
bool cold(std::span<const Row> rows);
/// Derives the states from impulses and velocities; without impulses all contacts stick.
void guess_states(std::span<const Row> rows, const std::vector<Response>& bodies, SolverWork& work);
/// Lets open contacts slide at first, so that they may take a share of the load.
void load_all_that_slide(std::span<const Row> rows, const std::vector<Response>& bodies,
                         SolverWork& work);
/// From the states in `work`; false if they did not settle.
bool solve_directly(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work);
/// Solves rows without impulses as if all of them stuck: the smallest impulses that hold them.
/// False, and still no impulses, if those would leave more than `enough` [m/s], as where rows had
/// to pull or to hold more than friction does.
bool solve_sticking(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work,
                    double enough);
/// Orders the bodies for `solve_by_bodies`; the order does not depend on the states of the rows.
void order_bodies(std::span<const Row> rows, const std::vector<Response>& bodies, SolverWork& work);
/// Solves rows without friction exactly, blind to mass ratios, by block principal pivoting
/// (Portugal, Judice and Vicente 1994): rows whose impulse pulls or whose velocity falls short of
/// its target change sides, all at once while this makes progress, else one by one. The cost grows
/// with the cube of the number of rows. Returns the residual; keeps the former impulses if their
/// residual is smaller.
double solve_by_pivoting(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work);
/// Solves the linear problem set up in `work`; returns false if no solution is found.
bool solve_by_bodies(std::span<const Row> rows, SolverWork& work);
/// Sweeps with Nesterov's momentum and its restart (O'Donoghue and Candes 2015), which settle high
/// piles in tens of sweeps where plain ones need thousands. Many rows are sorted by colour, and the
/// sweeps go on all threads.
double accelerated_sweeps(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work,
                          const Sweeps& sweeps);

/// The speed by which a solved problem may still want to change [units]: g h of a step of a
/// microsecond is a million times more.
inline constexpr double solved_speed = 1e-11;
/// The speed at which sweeps stop, the round-off of one unit: errors of many impacts add
/// up.
inline constexpr double settled_speed = 1e-13;

} // namespace hyoryu
