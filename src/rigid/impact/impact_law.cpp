// SPDX-License-Identifier: MIT
// Functions shared by the impact laws, and the default law: rounds with the coupled cone.
#include "impact_law.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Gain of energy, relative to what was exchanged, that is round-off and not the impact law.
constexpr double no_gain_of_impact = 1e-14;

// Work done by the contacts, 1/2 sum P . (u- + u+): the change of kinetic energy seen from the
// walls.
double work_done(const std::vector<Row>& rows, const std::vector<Response>& bodies)
{
    double work = 0;
    for (const Row& row : rows) {
        work += 0.5 * row.p.dot(row.before + velocity(row, bodies));
    }
    return work;
}

double exchanged(const std::vector<Row>& rows)
{
    double sum = 0;
    for (const Row& row : rows) {
        sum += std::abs(row.p.dot(row.before)) + 0.5 * row.p.dot(row.cone.K * row.p);
    }
    return sum;
}

// Scales the inelastic impulses to their passive share: they dissipate energy only as far as they
// were solved accurately.
void take_passive_share(std::vector<Row>& rows, std::vector<Response>& bodies)
{
    WorkOfShare work;
    for (const Row& row : rows) {
        work.linear += row.p.dot(row.before);
        work.square += 0.5 * row.p.dot(velocity(row, bodies) - row.before);
    }
    std::vector<Vec3> p;
    for (const Row& row : rows) {
        p.emplace_back(passive_share(work) * row.p);
    }
    set_impulses(rows, p, bodies);
}

// Largest s in [0, 1] with work(s) <= 0 on the line from the inelastic impulse P0 to P.
double dissipative_share(double work0, double work_half, double work1)
{
    const double a = 2 * (work1 + work0 - 2 * work_half);
    const double b = work1 - work0 - a;
    const double root = std::sqrt(std::max(sq(b) - 4 * a * work0, 0.0));
    const double s = b >= 0 ? -2 * work0 / (b + root) : (root - b) / (2 * a);
    return std::clamp(s, 0.0, 1.0);
}

} // namespace

void collect(const StepContext& context, const Round& round, double slower, std::vector<Row>& rows)
{
    ContactMemory& memory = context.memory;
    const RigidSettings& settings = context.rigid.settings;
    rows.clear();
    for (std::size_t k = 0; k < memory.candidates.size(); ++k) {
        const Candidate& c = memory.candidates[k];
        if ((c.touch.gap > settings.contact_tolerance && !c.closing) ||
            separation_speed(memory, c, round.time) >= slower) {
            continue;
        }
        Row row;
        row.a = c.feature.a;
        row.b = std::max(c.feature.b, -1);
        row.contact = static_cast<int>(k);
        const ContactLaws::Law& law = law_of(context.rigid, c.feature.a, c.feature.b);
        row.cone.mu = law.friction;
        row.wall_velocity = wall_velocity(memory, c.feature.b, round.time);
        const Vec3 xa = memory.poses[row.a].x;
        const Vec3 xb = row.b >= 0 ? memory.poses[row.b].x : xa;
        complete(row, {c.touch, c.touch}, {xa, xb, xa, xb}, memory.responses, settings.dimensions);
        if (row.cone.K(0, 0) <= 0) {
            continue; // neither body can move along the normal
        }
        row.before = velocity(row, memory.responses);
        const bool bounces =
            row.before[0] < -round.slow && !exceeds_event_limit(memory, c.feature.a, c.feature.b);
        row.target = bounces ? -law.restitution * row.before[0] : 0;
        rows.push_back(row);
    }
}

void clamp_energy(std::vector<Row>& rows, ContactMemory& memory, const Effort& effort)
{
    const double work1 = work_done(rows, memory.responses);
    if (work1 <= no_gain_of_impact * exchanged(rows)) {
        return;
    }
    std::vector<Vec3> p1;
    std::vector<double> targets;
    for (Row& row : rows) {
        p1.push_back(row.p);
        targets.push_back(row.target);
        row.target = 0;
    }
    solve_islands(rows, memory, effort);
    take_passive_share(rows, memory.responses);
    const double work0 = work_done(rows, memory.responses);
    std::vector<Vec3> p0;
    std::vector<Vec3> p_half;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        p0.push_back(rows[k].p);
        p_half.emplace_back(0.5 * (p0[k] + p1[k]));
        rows[k].target = targets[k];
    }
    set_impulses(rows, p_half, memory.responses);
    const double work_half = work_done(rows, memory.responses);
    const double s = work0 < 0 ? dissipative_share(work0, work_half, work1) : 0;
    std::vector<Vec3> p;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        p.emplace_back(p0[k] + s * (p1[k] - p0[k]));
    }
    set_impulses(rows, p, memory.responses);
}

double coupled_round(const StepContext& context, Round& round)
{
    ContactMemory& memory = context.memory;
    collect(context, round, -round.slow, memory.rows);
    round.closing = std::all_of(memory.rows.begin(), memory.rows.end(),
                                [&](const Row& row) { return !(-row.before[0] >= round.least); });
    if (memory.rows.empty()) {
        return 0;
    }
    if (round.closing) {
        collect(context, round, round.slow, memory.rows);
        for (Row& row : memory.rows) {
            row.target = 0;
        }
    }
    const double left = solve_islands(memory.rows, memory, round.effort);
    clamp_energy(memory.rows, memory, round.effort);
    return left;
}

} // namespace hyoryu
