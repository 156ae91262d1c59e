// SPDX-License-Identifier: MIT
// Impact rounds.
#include "impact_law.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// A cluster of n contacts settles in a few times n rounds; more means that they feed one another.
constexpr int most_rounds = 50;

double solve_round(const StepContext& context, double time)
{
    switch (context.rigid.settings.law) {
    case ImpactLaw::coupled:
        return coupled_round(context, time);
    case ImpactLaw::paper:
        return paper_round(context, time);
    case ImpactLaw::simultaneous:
        return simultaneous_round(context, time);
    }
    return 0;
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

// Books a round; the energy of the round is shared in proportion to what each contact lost, or, if
// the law may gain energy, as it is.
void book(const std::vector<Row>& rows, const StepContext& context, std::size_t first, double time)
{
    const ContactMemory& memory = context.memory;
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
    const double dissipated_share = positive > 0 ? std::max(total, 0.0) / positive : 0;
    const double share = may_gain ? 1 : dissipated_share;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const Row& row = rows[k];
        const Candidate& c = memory.candidates[row.contact];
        auto entry = std::find_if(context.log.begin() + static_cast<std::ptrdiff_t>(first),
                                  context.log.end(), [&](const Contact& known) {
                                      return known.a == c.feature.a && known.b == c.feature.b &&
                                             known.point == c.touch.point &&
                                             known.normal == c.touch.normal;
                                  });
        if (entry == context.log.end()) {
            Contact contact{Contact::Kind::impact, time,          c.feature.a,
                            c.feature.b,           c.touch.point, c.touch.normal};
            contact.approach_speed = std::max(0.0, -row.before[0]);
            contact.effective_mass = 1 / row.cone.K(0, 0);
            context.log.push_back(contact);
            entry = context.log.end() - 1;
        }
        entry->normal_impulse += row.p[0];
        entry->tangential_impulse += row.impulse() - row.p[0] * c.touch.normal;
        entry->energy_lost += share * losses[k];
    }
}

} // namespace

void solve_impacts(const StepContext& context, const Cluster& cluster, double time)
{
    ContactMemory& memory = context.memory;
    RigidCounters& counters = context.rigid.counters;
    const std::size_t first = context.log.size();
    set_responses(context, cluster);
    for (int round = 0; round < most_rounds; ++round) {
        const double left = solve_round(context, time);
        if (memory.rows.empty()) {
            break;
        }
        counters.worst_residual = std::max(counters.worst_residual, left);
        apply_round(memory.rows, context);
        book(memory.rows, context, first, time);
        set_responses(context, cluster);
        ++counters.rounds;
        for (const Row& row : memory.rows) {
            counters.tangential_impacts += row.tangential ? 1 : 0;
        }
    }
    counters.impacts += static_cast<long long>(context.log.size() - first);
}

} // namespace hyoryu
