// SPDX-License-Identifier: MIT
// Impact rounds.
#include "sub_step.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// A cluster of n contacts settles in a few times n rounds; more means that they feed one another.
constexpr int most_rounds = 50;
// Gain of energy, relative to what was exchanged, that is round-off and not the impact law.
constexpr double no_gain = 1e-14;

// All touching contacts that approach faster than the resting speed.
void collect(const StepContext& context, const SubStep& sub, double time, std::vector<Row>& rows)
{
    ContactMemory& memory = context.memory;
    const RigidSettings& settings = context.rigid.settings;
    rows.clear();
    for (std::size_t k = 0; k < memory.candidates.size(); ++k) {
        const Candidate& c = memory.candidates[k];
        if (c.beyond || (c.touch.gap > settings.contact_tolerance && !c.closing) ||
            separation_speed(memory, c, time) >= -sub.slow) {
            continue;
        }
        Row row;
        row.a = c.feature.a;
        row.b = std::max(c.feature.b, -1);
        row.contact = static_cast<int>(k);
        const ContactLaws::Law& law = law_of(context.rigid, c.feature.a, c.feature.b);
        row.cone.mu = law.friction;
        row.wall_velocity = wall_velocity(memory, c.feature.b, time);
        const Vec3 xa = memory.poses[row.a].x;
        const Vec3 xb = row.b >= 0 ? memory.poses[row.b].x : xa;
        complete(row, {c.touch, c.touch}, {xa, xb, xa, xb}, memory.responses, settings.dimensions);
        if (row.cone.K(0, 0) <= 0) {
            continue; // neither body can move along the normal
        }
        row.before = velocity(row, memory.responses);
        const bool no_bounce = tired(memory, c.feature.a, c.feature.b);
        row.target = no_bounce ? 0 : -law.restitution * row.before[0];
        rows.push_back(row);
    }
}

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

// Largest s in [0, 1] with work(s) <= 0 on the line from the inelastic impulse P0 to P.
double dissipative_share(double work0, double work_half, double work1)
{
    const double a = 2 * (work1 + work0 - 2 * work_half);
    const double b = work1 - work0 - a;
    const double root = std::sqrt(std::max(sq(b) - 4 * a * work0, 0.0));
    const double s = b >= 0 ? -2 * work0 / (b + root) : (root - b) / (2 * a);
    return std::clamp(s, 0.0, 1.0);
}

void set_impulses(std::vector<Row>& rows, const std::vector<Vec3>& p, std::vector<Response>& bodies)
{
    for (std::size_t k = 0; k < rows.size(); ++k) {
        push(rows[k], p[k] - rows[k].p, bodies);
    }
}

// If the round gained energy, goes back towards the inelastic impulse, which never does.
void clamp_energy(std::vector<Row>& rows, ContactMemory& memory)
{
    const double work1 = work_done(rows, memory.responses);
    if (work1 <= no_gain * exchanged(rows)) {
        return;
    }
    std::vector<Vec3> p1;
    std::vector<double> targets;
    for (Row& row : rows) {
        p1.push_back(row.p);
        targets.push_back(row.target);
        row.target = 0;
    }
    solve_islands(rows, memory);
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

// Velocities and momenta of the bodies after the round.
void apply_round(const std::vector<Row>& rows, const StepContext& context)
{
    for (const Row& row : rows) {
        const Vec3 P = row.impulse();
        const auto add = [&](int k, const Vec3& arm, double sign) {
            Body& body = context.rigid.bodies[k];
            body.velocity += sign * context.memory.rotors[k].inverse_mass.cwiseProduct(P);
            const Vec3 dL = sign * arm.cross(P);
            for (int m = 0; m < 3; ++m) {
                body.angular_momentum[m] += context.memory.rotors[k].turns[m] ? dL[m] : 0;
            }
        };
        add(row.a, row.arm_a, 1);
        if (row.b >= 0) {
            add(row.b, row.arm_b, -1);
        }
    }
}

// The log entry of another candidate of the same pair at the same place; -1 if there is none.
int entry_at_same_point(const ContactMemory& memory, int contact)
{
    const Candidate& c = memory.candidates[contact];
    const auto same = [&](int k) {
        const Candidate& other = memory.candidates[k];
        return memory.entries[k] >= 0 && other.touch.point == c.touch.point &&
               other.touch.normal == c.touch.normal;
    };
    const auto of_pair = [&](int k) {
        return k >= 0 && k < static_cast<int>(memory.candidates.size()) &&
               memory.candidates[k].feature.a == c.feature.a &&
               memory.candidates[k].feature.b == c.feature.b;
    };
    for (const int way : {-1, 1}) {
        for (int k = contact + way; of_pair(k); k += way) {
            if (same(k)) {
                return memory.entries[k];
            }
        }
    }
    return -1;
}

// Books a round; the energy of the round is shared in proportion to what each contact lost.
void book(const std::vector<Row>& rows, const StepContext& context, double time)
{
    ContactMemory& memory = context.memory;
    double total = 0;
    double positive = 0;
    std::vector<double> losses;
    for (const Row& row : rows) {
        const double loss = -0.5 * row.p.dot(row.before + velocity(row, memory.responses));
        losses.push_back(std::max(loss, 0.0));
        total += loss;
        positive += losses.back();
    }
    const double share = positive > 0 ? std::max(total, 0.0) / positive : 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const Row& row = rows[k];
        const Candidate& c = memory.candidates[row.contact];
        int& index = memory.entries[row.contact];
        index = index < 0 ? entry_at_same_point(memory, row.contact) : index;
        if (index < 0) {
            Contact contact{Contact::Kind::impact, time,          c.feature.a,
                            c.feature.b,           c.touch.point, c.touch.normal};
            contact.approach_speed = -row.before[0];
            contact.effective_mass = 1 / row.cone.K(0, 0);
            index = static_cast<int>(context.log.size());
            context.log.push_back(contact);
        }
        Contact& entry = context.log[index];
        entry.normal_impulse += row.p[0];
        entry.tangential_impulse += row.impulse() - row.p[0] * c.touch.normal;
        entry.energy_lost += share * losses[k];
    }
}

} // namespace

void solve_impacts(const StepContext& context, const SubStep& sub, double time)
{
    ContactMemory& memory = context.memory;
    RigidCounters& counters = context.rigid.counters;
    const std::size_t first = context.log.size();
    memory.entries.assign(memory.candidates.size(), -1);
    set_responses(context, sub.cluster);
    for (int round = 0; round < most_rounds; ++round) {
        collect(context, sub, time, memory.rows);
        if (memory.rows.empty()) {
            break;
        }
        const double left = solve_islands(memory.rows, memory);
        counters.worst_residual = std::max(counters.worst_residual, left);
        clamp_energy(memory.rows, memory);
        apply_round(memory.rows, context);
        book(memory.rows, context, time);
        set_responses(context, sub.cluster);
        ++counters.rounds;
        for (const Row& row : memory.rows) {
            counters.tangential_impacts += row.tangential ? 1 : 0;
        }
    }
    counters.impacts += static_cast<long long>(context.log.size() - first);
}

} // namespace hyoryu
