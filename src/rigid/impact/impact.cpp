// SPDX-License-Identifier: MIT
// Impact rounds: repeats the rounds of the impact law until no contact approaches, and logs them.
#include "impact_law.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// Remaining approach speeds below this part of the first are negligible: 1e-4 of its energy.
constexpr double rattle = 0.01;

double solve_round(const StepContext& context, Round& round)
{
    switch (context.rigid.settings.law) {
    case ImpactLaw::coupled:
        return coupled_round(context, round);
    case ImpactLaw::paper:
        return paper_round(context, round);
    case ImpactLaw::simultaneous:
        return simultaneous_round(context, round);
    }
    return 0;
}

double fastest(const std::vector<Row>& rows)
{
    double most = 0;
    for (const Row& row : rows) {
        most = std::max(most, -row.before[0]);
    }
    return most;
}

// Applies the impulses of the round to the velocities and momenta of the bodies.
void apply_round(const std::vector<Row>& rows, const StepContext& context)
{
    for (const Row& row : rows) {
        const Vec3 P = row.impulse();
        const auto add = [&](int k, const Mat3& turn, double sign) {
            Body& body = context.rigid.bodies[k];
            body.velocity += sign * context.memory.rotors[k].inverse_mass.cwiseProduct(P);
            const Vec3 dL = sign * (turn * row.p);
            for (int m = 0; m < 3; ++m) {
                body.angular_momentum[m] += context.memory.rotors[k].turns[m] ? dL[m] : 0;
            }
        };
        add(row.a, row.turn_a, 1);
        if (row.b >= 0) {
            add(row.b, row.turn_b, -1);
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

// Logs a round. Its total loss of energy is distributed in proportion to the losses of the
// contacts; if the law may gain energy, each contact keeps its own value.
void record(const std::vector<Row>& rows, const StepContext& context, const SubStep& sub,
            double time)
{
    const bool located = sub.arms == Arms::ahead;
    ContactMemory& memory = context.memory;
    const bool may_gain = context.rigid.settings.law == ImpactLaw::paper;
    double total = 0;
    double positive = 0;
    std::vector<double> losses;
    for (const Row& row : rows) {
        const double loss = -0.5 * row.p.dot(row.before + velocity(row, memory.responses));
        losses.push_back(may_gain ? loss : std::max(loss, 0.0));
        total += loss;
        positive += losses.back();
    }
    memory.lost += total;
    const double dissipated_share = positive > 0 ? std::max(total, 0.0) / positive : 0;
    const double share = may_gain ? 1 : dissipated_share;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const Row& row = rows[k];
        const Candidate& c = memory.candidates[row.contact];
        int& index = memory.entries[row.contact];
        index = index < 0 ? entry_at_same_point(memory, row.contact) : index;
        if (index < 0) {
            Contact contact{Contact::Kind::impact, time,          c.feature.a,
                            c.feature.b,           c.touch.point, c.touch.normal};
            contact.approach_speed = std::max(0.0, -row.before[0]);
            contact.effective_mass = 1 / row.cone.K(0, 0);
            contact.depth = std::max(0.0, -c.touch.gap);
            contact.located = located && !exceeds_event_limit(memory, c.feature.a, c.feature.b);
            index = static_cast<int>(context.log.size());
            context.log.push_back(contact);
        }
        Contact& entry = context.log[index];
        entry.normal_impulse += row.p[0];
        entry.tangential_impulse += row.impulse() - row.p[0] * c.touch.normal;
        entry.energy_lost += share * losses[k];
    }
}

// Removes the entries from `first` on without an impulse: in a heap they are half of all.
void forget_idle(std::vector<Contact>& log, std::size_t first)
{
    const auto is_idle = [](const Contact& contact) {
        return contact.normal_impulse == 0 && contact.tangential_impulse.isZero(0);
    };
    const auto begin = log.begin() + static_cast<std::ptrdiff_t>(first);
    log.erase(std::remove_if(begin, log.end(), is_idle), log.end());
}

} // namespace

double solve_impacts(const StepContext& context, const SubStep& sub, double time)
{
    ContactMemory& memory = context.memory;
    RigidCounters& counters = context.rigid.counters;
    const std::size_t first = context.log.size();
    memory.entries.assign(memory.candidates.size(), -1);
    set_responses(context, sub.cluster);
    double left = 0;
    Round round{time, sub.slow, sub.impact_effort};
    for (int count = 1; !round.closing; ++count) {
        const double change = solve_round(context, round);
        if (memory.rows.empty()) {
            break;
        }
        left = change; // later rounds correct the residual of earlier ones
        apply_round(memory.rows, context);
        record(memory.rows, context, sub, time);
        set_responses(context, sub.cluster);
        ++counters.rounds;
        for (const Row& row : memory.rows) {
            counters.tangential_impacts += row.tangential ? 1 : 0;
        }
        const bool enough = count >= sub.most_rounds || !is_worth_locating(memory);
        round.least = enough ? infinity : std::max(round.least, rattle * fastest(memory.rows));
    }
    forget_idle(context.log, first);
    counters.impacts += static_cast<long long>(context.log.size() - first);
    return left;
}

} // namespace hyoryu
