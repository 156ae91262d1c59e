// SPDX-License-Identifier: MIT
// The direct solution of a contact problem: Newton's method on the condition that every impulse is
// the projection of p - r (u - u*) onto the friction cone (Alart and Curnier 1991), r an effective
// mass. This is an active-set method with the states stick, slide and open, in which the direction
// of sliding is an additional unknown.
#include "solver.hpp"

#include <Eigen/QR>

#include <algorithm>

namespace hyoryu {

namespace {

enum State { open = 0, slides = 1, sticks = 2 };

// Most changes of the active set; the sweeps take over afterwards.
constexpr int most_active_sets = 12;
// Most consecutive rounds that do not reduce the least residual so far to this part.
constexpr int rounds_without_gain = 3;
constexpr double improvement = 0.7;
// A sliding direction that turns by less has converged: the remaining error is its square [rad].
constexpr double settled_direction = 3e-8;
// Friction less than this part below the limit counts as on the cone.
constexpr double on_cone = 1e-9;
// Relative rank tolerance of the redundant, symmetric problem (round-off times condition).
constexpr double rank_tolerance = 1e-11;
constexpr int most_corrections = 6;
// Residual at which the corrections end, relative to the right-hand side.
constexpr double left_by_corrections = 1e-13;

// A factorisation of n unknowns costs as much as n^3 over this number of updates of rows.
constexpr double factored_in_an_update = 250;

int unknowns(const Row& row, int state)
{
    if (state == slides) {
        return row.cone.size == 3 ? 2 : 1; // in space the direction of sliding is an unknown, too
    }
    return state == sticks ? row.cone.size : 0;
}

// The unit tangent perpendicular to the direction of sliding.
Vec3 across(const Vec3& d)
{
    return {0, -d[2], d[1]};
}

// Direction of unknown m of the impulse of a contact in the given state, in the axes of the
// contact.
Vec3 direction(const Row& row, int state, const Vec3& d, int m)
{
    if (state == sticks) {
        return Vec3::Unit(m);
    }
    return m == 0 ? Vec3(Vec3(1, 0, 0) - row.cone.mu * d) : across(d);
}

// The velocity component that equation m of a contact constrains.
Vec3 asked(int state, const Vec3& d, int m)
{
    return state == slides && m == 1 ? across(d) : Vec3(Vec3::Unit(m));
}

double tangential_mass(const Row& row)
{
    return 1 / row.cone.K(1, 1);
}

// Minus the point whose projection onto the disc of radius mu p_n is the friction; its direction is
// the direction of sliding if the contact slides [N s].
Vec3 sliding_point(const Row& row, const Vec3& u)
{
    const double r = tangential_mass(row);
    return {0, r * u[1] - row.p[1], row.cone.size == 3 ? r * u[2] - row.p[2] : 0};
}

// The weight w of the sticking condition in the direction perpendicular to sliding [1]; with the
// rest the contact yields with the mass r: w u + (1 - w) q / r = 0 for the impulse q in this
// direction.
double part_held(const Row& row, const Vec3& u)
{
    const double cap = row.cone.mu * std::max(row.p[0], 0.0);
    const double most = std::max(cap, sliding_point(row, u).norm());
    return most > 0 ? cap / most : 1;
}

bool share_a_body(const Row& i, const Row& j)
{
    return i.a == j.a || i.a == j.b || (i.b >= 0 && (i.b == j.a || i.b == j.b));
}

Vec6 joined(const Vec3& linear, const Vec3& angular)
{
    Vec6 both;
    both << linear, angular;
    return both;
}

// The change of the velocities of a body under the impulse P with the given moment.
Vec6 answer(const Response& body, const Vec3& P, const Vec3& moment)
{
    return joined(body.inverse_mass.cwiseProduct(P), body.inverse_inertia * moment);
}

// Numbers the unknowns, and sets the response of the bodies to each and the coefficients of its
// equation.
void lay_out(std::span<const Row> rows, const std::vector<Response>& bodies, SolverWork& work)
{
    work.columns.clear();
    work.across.clear();
    work.unknowns.clear();
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const Row& row = rows[k];
        const int state = work.states[k];
        const Vec3& d = work.directions[k];
        work.columns.push_back(static_cast<int>(work.unknowns.size()));
        work.across.push_back(unknowns(row, state) == 2 && state == slides ? work.columns.back() + 1
                                                                           : -1);
        for (int m = 0; m < unknowns(row, state); ++m) {
            const Vec3 p = direction(row, state, d, m);
            const Vec3 P = row.B * p;
            const Vec3 u = asked(state, d, m);
            const Vec3 n = row.D * u;
            Unknown unknown{answer(bodies[row.a], P, row.turn_a * p), Vec6::Zero(),
                            joined(n, row.lever_a * u), Vec6::Zero()};
            if (row.b >= 0) {
                unknown.response_b = -answer(bodies[row.b], P, row.turn_b * p);
                unknown.jacobian_b = -joined(n, row.lever_b * u);
            }
            work.unknowns.push_back(unknown);
        }
    }
    work.columns.push_back(static_cast<int>(work.unknowns.size()));
}

// Sets the block (i, j) of W.
void couple(const Row& i, const Row& j, SolverWork& work, std::size_t at_i, std::size_t at_j)
{
    for (int m = work.columns[at_j]; m < work.columns[at_j + 1]; ++m) {
        const Unknown& by = work.unknowns[m];
        for (int r = work.columns[at_i]; r < work.columns[at_i + 1]; ++r) {
            const Unknown& at = work.unknowns[r];
            double w = 0;
            w += i.a == j.a ? at.jacobian_a.dot(by.response_a) : 0;
            w += i.a == j.b ? at.jacobian_a.dot(by.response_b) : 0;
            w += i.b >= 0 && i.b == j.a ? at.jacobian_b.dot(by.response_a) : 0;
            w += i.b >= 0 && i.b == j.b ? at.jacobian_b.dot(by.response_b) : 0;
            work.W(r, m) = w;
        }
    }
}

// Sets the right-hand side: the required changes of the velocities.
void set_right_side(std::span<const Row> rows, SolverWork& work)
{
    work.rhs.setZero(static_cast<Index>(work.unknowns.size()));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Vec3 change = Vec3(rows[i].target, 0, 0) - work.momenta[i];
        const int first = work.columns[i];
        for (int r = first; r < work.columns[i + 1]; ++r) {
            work.rhs[r] = change.dot(asked(work.states[i], work.directions[i], r - first));
        }
        if (work.across[i] >= 0) {
            work.rhs[work.across[i]] *= work.held[i];
        }
    }
}

void assemble(std::span<const Row> rows, SolverWork& work)
{
    const auto n = static_cast<Index>(work.unknowns.size());
    work.W.setZero(n, n);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::size_t j = 0; j < rows.size(); ++j) {
            if (share_a_body(rows[i], rows[j])) {
                couple(rows[i], rows[j], work, i, j);
            }
        }
        if (const int m = work.across[i]; m >= 0) {
            work.W.row(m) *= work.held[i];
            work.W(m, m) += (1 - work.held[i]) / tangential_mass(rows[i]);
        }
    }
}

// Solves W x = rhs by a shifted problem. W is singular for redundant contacts such as the corners
// of a box; corrections converge to the solution of least norm (iterated regularisation, Riley
// 1955). Returns false if they do not converge.
bool solve_shifted(SolverWork& work)
{
    const Index n = work.W.rows();
    const double most = work.W.diagonal().maxCoeff();
    work.factor.compute(work.W + work.shift * most * DenseMatrix::Identity(n, n));
    work.solution.setZero(n);
    work.left_over = work.rhs;
    const double enough = left_by_corrections * work.rhs.lpNorm<Eigen::Infinity>();
    for (int k = 0; k < most_corrections; ++k) {
        work.solution += work.factor.solve(work.left_over);
        work.left_over = work.rhs - work.W * work.solution;
        if (work.left_over.lpNorm<Eigen::Infinity>() <= enough) {
            return true;
        }
    }
    return false;
}

// The least-squares solution of least norm to machine precision, at ten times the cost.
void solve_orthogonally(SolverWork& work)
{
    Eigen::CompleteOrthogonalDecomposition<DenseMatrix> decomposition;
    decomposition.setThreshold(rank_tolerance);
    decomposition.compute(work.W);
    work.solution = decomposition.solve(work.rhs);
}

bool solve_densely(std::span<const Row> rows, SolverWork& work)
{
    assemble(rows, work);
    const auto n = static_cast<double>(work.W.rows());
    work.updates += n * n * n / factored_in_an_update;
    if (work.W.size() > 0 && !solve_shifted(work)) {
        solve_orthogonally(work);
    }
    return true;
}

// Impulses of all rows from the solution of the reduced problem, applied to the bodies.
void apply(std::span<Row> rows, std::vector<Response>& bodies, const SolverWork& work)
{
    for (std::size_t k = 0; k < rows.size(); ++k) {
        Vec3 p = work.base[k];
        for (int m = 0; m < unknowns(rows[k], work.states[k]); ++m) {
            p += work.solution[work.columns[k] + m] *
                 direction(rows[k], work.states[k], work.directions[k], m);
        }
        push(rows[k], p - rows[k].p, bodies);
    }
}

// The state of a contact with the given impulse and velocity; sets the direction if it slides.
int state_of(const Row& row, const Vec3& u, double p_n, Vec3& d)
{
    if (p_n <= 0) {
        return open;
    }
    const Vec3 y = sliding_point(row, u);
    if (row.cone.size == 1 || y.norm() <= (1 - on_cone) * row.cone.mu * p_n) {
        return sticks;
    }
    d = y.normalized();
    return slides;
}

// Updates the states from the solution; returns whether any of them changed.
bool improve_states(std::span<const Row> rows, const std::vector<Response>& bodies,
                    SolverWork& work)
{
    const double solved = solved_speed * work.unit;
    bool changed = false;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const Row& row = rows[k];
        const Vec3 u = velocity(row, bodies);
        const Vec3 last = work.directions[k];
        const int now = work.states[k];
        // A closed contact has its target normal velocity up to round-off.
        const double approach = row.target - u[0];
        const double p_n = now != open         ? row.p[0]
                           : approach > solved ? approach / row.cone.K(0, 0)
                                               : 0;
        work.states[k] = state_of(row, u, p_n, work.directions[k]);
        work.held[k] = part_held(row, u);
        changed = changed || work.states[k] != now ||
                  (now == slides && (work.directions[k] - last).norm() > settled_direction);
    }
    return changed;
}

// Sets the base to the impulses nearest to those of the rows that the states allow. For redundant
// contacts the solution nearest to them most likely has the right states; the solution of least
// norm would redistribute the load of a whole pile.
void choose_base(std::span<const Row> rows, SolverWork& work)
{
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const Row& row = rows[k];
        Vec3& base = work.base[k];
        base = Vec3::Zero();
        if (work.states[k] == sticks) {
            base.head(row.cone.size) = row.p.head(row.cone.size);
        } else if (work.states[k] == slides) {
            base = row.p[0] * direction(row, slides, work.directions[k], 0);
        }
    }
}

// Applies the base impulses and stores the resulting contact velocities.
void start_from_base(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work)
{
    work.momenta.clear();
    for (std::size_t k = 0; k < rows.size(); ++k) {
        push(rows[k], work.base[k] - rows[k].p, bodies);
    }
    for (const Row& row : rows) {
        work.momenta.push_back(velocity(row, bodies));
    }
}

} // namespace

bool cold(std::span<const Row> rows)
{
    return std::all_of(rows.begin(), rows.end(), [](const Row& row) { return row.p.isZero(0); });
}

void guess_states(std::span<const Row> rows, const std::vector<Response>& bodies, SolverWork& work)
{
    const bool unknown = cold(rows);
    work.states.clear();
    work.held.clear();
    work.directions.assign(rows.size(), Vec3::Zero());
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const Row& row = rows[k];
        const Vec3 u = velocity(row, bodies);
        const double p_n = row.p[0] + (row.target - u[0]) / row.cone.K(0, 0);
        work.states.push_back(unknown ? static_cast<int>(sticks)
                                      : state_of(row, u, p_n, work.directions[k]));
        work.held.push_back(part_held(row, u));
    }
}

void load_all_that_slide(std::span<const Row> rows, const std::vector<Response>& bodies,
                         SolverWork& work)
{
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const Vec3 y = sliding_point(rows[k], velocity(rows[k], bodies));
        if (work.states[k] == open && y.norm() > 0) {
            work.states[k] = slides;
            work.directions[k] = y.normalized();
        }
    }
}

bool solve_directly(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work)
{
    const bool by_bodies = rows.size() > dense_contacts;
    if (by_bodies) {
        order_bodies(rows, bodies, work);
    }
    work.base.assign(rows.size(), Vec3::Zero());
    if (!by_bodies) { // a pile starts from its present impulses
        start_from_base(rows, bodies, work);
    }
    bool changed = true;
    double best = infinity;
    int since_best = 0;
    for (int round = 0; round < most_active_sets && changed && since_best < rounds_without_gain;
         ++round) {
        if (by_bodies) {
            choose_base(rows, work);
            start_from_base(rows, bodies, work);
        }
        lay_out(rows, bodies, work);
        set_right_side(rows, work);
        const bool solved = by_bodies ? solve_by_bodies(rows, work) : solve_densely(rows, work);
        if (!solved || !work.solution.allFinite()) {
            return false; // keeps the impulses of the last round
        }
        apply(rows, bodies, work);
        changed = improve_states(rows, bodies, work);
        if (by_bodies) {
            const double left = residual(rows, bodies);
            changed = changed && left > solved_speed * work.unit;
            since_best = left < improvement * best ? 0 : since_best + 1;
            best = std::min(best, left);
        }
    }
    return !changed;
}

bool solve_sticking(std::span<Row> rows, std::vector<Response>& bodies, SolverWork& work,
                    double enough)
{
    work.states.assign(rows.size(), static_cast<int>(sticks));
    work.held.assign(rows.size(), 1);
    work.directions.assign(rows.size(), Vec3::Zero());
    work.base.assign(rows.size(), Vec3::Zero());
    order_bodies(rows, bodies, work);
    work.velocities.clear();
    for (const int body : work.blocks.members) {
        work.velocities.push_back({bodies[body].v, bodies[body].omega});
    }
    const auto take_back = [&] { // exactly
        for (std::size_t k = 0; k < work.velocities.size(); ++k) {
            Response& body = bodies[work.blocks.members[k]];
            body.v = work.velocities[k].v;
            body.omega = work.velocities[k].omega;
        }
        for (Row& row : rows) {
            row.p.setZero();
        }
        return false;
    };
    constexpr int passes = 2; // the second removes the round-off of the first
    for (int pass = 0; pass < passes; ++pass) {
        choose_base(rows, work);
        start_from_base(rows, bodies, work);
        lay_out(rows, bodies, work);
        set_right_side(rows, work);
        if (!solve_by_bodies(rows, work) || !work.solution.allFinite()) {
            return pass > 0 || take_back();
        }
        apply(rows, bodies, work);
        if (residual(rows, bodies) > enough) {
            return take_back();
        }
    }
    return true;
}

} // namespace hyoryu
