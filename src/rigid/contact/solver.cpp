// SPDX-License-Identifier: MIT
// The strategy of the contact solver: direct solutions and Gauss-Seidel sweeps in turns.
#include "solver.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// A single body with at most this number of contacts is solved by Gauss-Seidel in a few sweeps.
constexpr std::size_t few_contacts = 24;
constexpr int few_sweeps = 60;
constexpr int sweeps_at_once = 20;
// Least number of sweeps of a turn.
constexpr std::size_t fewest_sweeps = 60;
constexpr std::size_t fewest_between_tries = 20;
// All known impulses are dropped after this number of turns: a pile would drop them one by one.
constexpr int turns_of_dropping = 3;

bool one_body(std::span<const Row> rows, const std::vector<Response>& bodies)
{
    return std::all_of(rows.begin(), rows.end(), [&](const Row& row) {
        return row.a == rows[0].a && (row.b < 0 || !bodies[row.b].movable);
    });
}

// The largest change of velocity required at a contact.
double change_asked(std::span<const Row> rows)
{
    double most = 0;
    for (const Row& row : rows) {
        most = std::max(most, (row.before - row.slip - Vec3(row.target, 0, 0)).norm());
    }
    return most;
}

bool without_friction(std::span<const Row> rows)
{
    return std::ranges::all_of(rows, [](const Row& row) { return row.cone.size == 1; });
}

struct Turns {
    int direct_tries = 0;
    int sweeps = 0;    // in each turn
    double enough = 0; // may be left [m/s]
};

// Tries the direct solution; restores the former impulses if its residual is larger.
double try_directly(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work,
                    double left)
{
    return left_by(rows, bodies, work, left, left, [&] {
        guess_states(rows, bodies, work);
        solve_directly(rows, bodies, work);
    });
}

// Whether the contacts are redundant and slide, so that their share of the load affects the motion.
// Sweeps converge to the distribution nearest to the guess; the direct solution gives the even one,
// which does not depend on the guess.
bool slide_together(std::span<const Row> rows)
{
    constexpr std::size_t determined = 3; // contacts of one body in a plane
    return rows.size() > determined &&
           std::ranges::any_of(rows, [](const Row& row) { return !row.slip.isZero(0); });
}

// Returns the residual of the direct solution, or infinity with the old impulses if it fails.
double share_evenly(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work)
{
    return left_by(rows, bodies, work, solved_speed * work.unit, infinity, [&] {
        guess_states(rows, bodies, work);
        load_all_that_slide(rows, bodies, work);
        work.shift = large_shift;
        solve_directly(rows, bodies, work);
        work.shift = small_shift;
    });
}

// Alternates direct solutions and sweeps: the sweeps find which contacts stick, slide and open, and
// the direct solution starts from these states (Silcowitz, Niebe and Erleben 2010). Even a small
// residual of the known impulses is reduced further: it would accumulate to speeds that a later
// solution cancels by an excessive force in the next sub-step, and so on. A direct solution leaves
// round-off, which one sweep damps.
double solve_in_turns(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work,
                      const Turns& turns)
{
    double left = residual(rows, bodies);
    if (left <= solved_speed * work.unit) {
        gauss_seidel(rows, bodies, {1, 0});
    } else if (left <= turns.enough && turns.direct_tries > 0) {
        left = try_directly(rows, bodies, work, left);
    }
    for (int k = 0; k <= turns.direct_tries && left > turns.enough; ++k) {
        left = k < turns.direct_tries ? try_directly(rows, bodies, work, left) : left;
        if (left > turns.enough) {
            accelerated_sweeps(rows, bodies, work, {turns.sweeps, turns.enough});
            left = residual(rows, bodies);
        }
    }
    return left;
}

// The contribution of a known impulse to the objective function that the frictionless solution
// minimises, p.(u_free + u)/2 - p_n u*; the function is zero without impulses [J].
double share_of_guess(const Row& row, const std::vector<Response>& bodies)
{
    return row.p.dot(0.5 * (row.before + velocity(row, bodies)) - Vec3(row.target, 0, 0));
}

// If the known impulses are worse than none, removes those with a positive contribution,
// repeatedly: an impact absorbed at the very end of a step would appear as a huge force in the
// next.
void drop_bad_guess(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work)
{
    double sum = 1;
    for (int turn = 0; sum > 0; ++turn) {
        sum = 0;
        work.shares.clear();
        for (const Row& row : rows) {
            work.shares.push_back(share_of_guess(row, bodies));
            sum += work.shares.back();
        }
        for (std::size_t k = 0; k < rows.size() && sum > 0; ++k) {
            if (work.shares[k] > 0 || turn == turns_of_dropping) {
                push(rows[k], -rows[k].p, bodies);
                rows[k].p.setZero();
            }
        }
    }
}

Turns turns_for(std::span<const Row> rows, const Effort& effort, double enough)
{
    const std::size_t fewest = effort.direct_tries > 0 ? fewest_between_tries : fewest_sweeps;
    const std::size_t sweeps = std::max(fewest, effort.updates / rows.size());
    return {effort.direct_tries, std::min(effort.sweeps, static_cast<int>(sweeps)), enough};
}

// `part`: the allowed residual relative to the largest required change of velocity.
double solve_rows(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work,
                  const Effort& effort, double part)
{
    const double asked = change_asked(rows);
    drop_bad_guess(rows, bodies, work);
    const double enough = std::max(part * asked, solved_speed * work.unit);
    // Without known impulses a large island is first solved as a pile at rest, with the impulses of
    // least norm. Sweeps from zero would leave internal forces between the contacts of a face that
    // carry no load and exceed friction; no direct solution removes them if heavy bodies stand on
    // light ones.
    if (cold(rows) &&
        !(rows.size() >= effort.stuck && solve_sticking(rows, bodies, work, enough))) {
        gauss_seidel(rows, bodies, {sweeps_at_once, enough});
    }
    const double left = solve_in_turns(rows, bodies, work, turns_for(rows, effort, enough));
    work.unsolved = left > asked / 2;
    return left;
}

// Solves the contacts of a single body.
double solve_alone(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work,
                   const Effort& effort)
{
    const double change = gauss_seidel(rows, bodies, {few_sweeps, settled_speed * work.unit});
    return change <= solved_speed * work.unit ? change : solve_rows(rows, bodies, work, effort, 0);
}

} // namespace

double solve(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work,
             const Effort& effort)
{
    work.unsolved = false;
    if (rows.size() == 1) {
        gauss_seidel(rows, bodies, {1, 0});
        return 0;
    }
    if (rows.size() <= effort.pivoted && without_friction(rows)) {
        return solve_by_pivoting(rows, bodies, work);
    }
    if (rows.size() > few_contacts || !one_body(rows, bodies)) {
        return solve_rows(rows, bodies, work, effort, effort.enough);
    }
    if (!slide_together(rows)) {
        return solve_alone(rows, bodies, work, effort);
    }
    const double known = residual(rows, bodies);
    if (known <= settled_speed * work.unit) {
        return known; // steady sliding with the load shared as in the last step
    }
    const double left = share_evenly(rows, bodies, work);
    if (left < infinity) {
        return left;
    }
    const double left_alone = solve_alone(rows, bodies, work, effort);
    return std::min(left_alone, share_evenly(rows, bodies, work));
}

} // namespace hyoryu
