// SPDX-License-Identifier: MIT
// The direct solution of a contact problem with an active set: contacts stick, slide or are open.
#include "solver.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

enum State { open = 0, slides = 1, sticks = 2 };

// Changes of the active set after which the iteration takes over.
constexpr int rounds_of_guesses = 4;
// A sliding direction has settled when it turns by less [rad].
constexpr double settled_direction = 1e-9;
// An impulse this part below the cone lies on it.
constexpr double on_cone = 1e-9;
// Relative rank tolerance of the redundant, symmetric problem (round-off times condition).
constexpr double rank_tolerance = 1e-11;
// Shift of the diagonal that makes the problem regular, as a part of its largest entry; the
// round-off in how redundant contacts share their load is that of the numbers over this.
constexpr double shift = 1e-8;
constexpr int corrections = 6;
// What the corrections may leave of the right-hand side.
constexpr double corrected = 1e-13;

// A factorisation takes as long as so many updates of rows as the cube of its unknowns over this.
constexpr double factored_in_an_update = 250;

double cubed(double x)
{
    return x * x * x;
}

int unknowns(const Row& row, int state)
{
    return state == sticks ? row.cone.size : state;
}

// Column m of the impulses a contact may have in its state, in its axes.
Vec3 direction(const Row& row, int state, const Vec3& d, int m)
{
    return state == sticks ? Vec3(Vec3::Unit(m)) : Vec3(Vec3(1, 0, 0) - row.cone.mu * d);
}

// The change of velocity at row i for the impulse p of row j.
Vec3 coupling(const Row& i, const Row& j, const Vec3& p, const std::vector<Response>& bodies)
{
    Vec3 u = Vec3::Zero();
    const Vec3 P = j.B * p;
    const auto add = [&](int body, const Vec3& seen, const Vec3& arm, double sign) {
        const Response& r = bodies[body];
        u += sign *
             (r.inverse_mass.cwiseProduct(P) + (r.inverse_inertia * arm.cross(P)).cross(seen));
    };
    if (i.a == j.a) {
        add(i.a, i.seen_a, j.arm_a, 1);
    }
    if (i.a == j.b) {
        add(i.a, i.seen_a, j.arm_b, -1);
    }
    if (i.b >= 0 && i.b == j.a) {
        add(i.b, i.seen_b, j.arm_a, -1);
    }
    if (i.b >= 0 && i.b == j.b) {
        add(i.b, i.seen_b, j.arm_b, 1);
    }
    return i.D.transpose() * u;
}

bool share_a_body(const Row& i, const Row& j)
{
    return i.a == j.a || i.a == j.b || (i.b >= 0 && (i.b == j.a || i.b == j.b));
}

void assemble(std::span<Row> rows, const std::vector<Response>& bodies, SolverWork& work)
{
    int n = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        work.columns[k] = n;
        n += unknowns(rows[k], work.states[k]);
    }
    work.W.setZero(n, n);
    work.rhs.setZero(n);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const int mi = unknowns(rows[i], work.states[i]);
        if (mi == 0) {
            continue;
        }
        Vec3 u = -work.momenta[i]; // velocity without any impulse
        u[0] += rows[i].target;
        for (int r = 0; r < mi; ++r) {
            work.rhs[work.columns[i] + r] = u[r];
        }
        for (std::size_t j = 0; j < rows.size(); ++j) {
            if (!share_a_body(rows[i], rows[j])) {
                continue;
            }
            for (int m = 0; m < unknowns(rows[j], work.states[j]); ++m) {
                const Vec3 p = direction(rows[j], work.states[j], work.directions[j], m);
                const Vec3 w = coupling(rows[i], rows[j], p, bodies);
                for (int r = 0; r < mi; ++r) {
                    work.W(work.columns[i] + r, work.columns[j] + m) = w[r];
                }
            }
        }
    }
}

// W x = rhs by a shifted problem: W is singular where contacts share a load in many ways, as the
// corners of a box do, and corrections lead to the solution of the smallest norm (iterated
// regularisation, Riley 1955). False if they do not.
bool solve_shifted(SolverWork& work)
{
    const Index n = work.W.rows();
    const double most = work.W.diagonal().maxCoeff();
    work.factor.compute(work.W + shift * most * Eigen::MatrixXd::Identity(n, n));
    work.solution.setZero(n);
    work.left_over = work.rhs;
    const double enough = corrected * work.rhs.lpNorm<Eigen::Infinity>();
    for (int k = 0; k < corrections; ++k) {
        work.solution += work.factor.solve(work.left_over);
        work.left_over = work.rhs - work.W * work.solution;
        if (work.left_over.lpNorm<Eigen::Infinity>() <= enough) {
            return true;
        }
    }
    return false;
}

// The same to the last bit, or the best there is, for ten times the cost.
void solve_orthogonally(SolverWork& work)
{
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
    decomposition.setThreshold(rank_tolerance);
    decomposition.compute(work.W);
    work.solution = decomposition.solve(work.rhs);
}

// Impulses of all rows from the solution of the reduced problem, applied to the bodies.
void apply(std::span<Row> rows, std::vector<Response>& bodies, const SolverWork& work)
{
    for (std::size_t k = 0; k < rows.size(); ++k) {
        Vec3 p = Vec3::Zero();
        for (int m = 0; m < unknowns(rows[k], work.states[k]); ++m) {
            p += work.solution[work.columns[k] + m] *
                 direction(rows[k], work.states[k], work.directions[k], m);
        }
        push(rows[k], p - rows[k].p, bodies);
    }
}

// The state a contact should have had, from its impulse and velocity.
int better_state(const Row& row, const Vec3& u, int state, Vec3& d)
{
    if (state == open) {
        return u[0] < row.target - solved_speed ? sticks : open;
    }
    if (row.p[0] < 0) {
        return open;
    }
    Vec3 t = row.p;
    t[0] = 0;
    if (state == sticks) {
        if (row.cone.size == 1 || t.norm() <= row.cone.mu * row.p[0]) {
            return sticks;
        }
        d = -t.normalized();
        return slides;
    }
    Vec3 slip(0, u[1], row.cone.size == 3 ? u[2] : 0);
    if (slip.dot(d) < -solved_speed) {
        return sticks;
    }
    if (slip.norm() > solved_speed && (slip.normalized() - d).norm() > settled_direction) {
        d = slip.normalized();
        return slides + 2; // slides, in a new direction
    }
    return slides;
}

} // namespace

bool cold(std::span<const Row> rows)
{
    return std::all_of(rows.begin(), rows.end(), [](const Row& row) { return row.p.isZero(0); });
}

void guess_states(std::span<const Row> rows, SolverWork& work)
{
    const bool unknown = cold(rows);
    work.states.clear();
    work.directions.assign(rows.size(), Vec3::Zero());
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const Vec3& p = rows[k].p;
        const Vec3 t(0, p[1], p[2]);
        const bool inside =
            rows[k].cone.size == 1 || t.norm() < (1 - on_cone) * rows[k].cone.mu * p[0];
        work.states.push_back(unknown || (inside && p[0] > 0) ? sticks : p[0] > 0 ? slides : open);
        if (work.states.back() == slides) {
            work.directions[k] = -t.normalized();
        }
    }
}

bool solve_directly(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work)
{
    const std::size_t n = rows.size();
    work.columns.assign(n, 0);
    work.momenta.clear();
    for (Row& row : rows) {
        push(row, -row.p, bodies);
    }
    for (const Row& row : rows) {
        work.momenta.push_back(velocity(row, bodies));
    }
    bool changed = true;
    for (int round = 0; round < rounds_of_guesses && changed; ++round) {
        assemble(rows, bodies, work);
        work.updates += cubed(static_cast<double>(work.W.rows())) / factored_in_an_update;
        if (work.W.size() > 0 && !solve_shifted(work)) {
            solve_orthogonally(work);
        }
        apply(rows, bodies, work);
        changed = false;
        for (std::size_t k = 0; k < n; ++k) {
            const int now = work.states[k];
            const int next =
                better_state(rows[k], velocity(rows[k], bodies), now, work.directions[k]);
            changed = changed || next != now;
            work.states[k] = next > sticks ? static_cast<int>(slides) : next;
        }
    }
    return !changed;
}

} // namespace hyoryu
