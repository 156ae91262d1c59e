// SPDX-License-Identifier: MIT
#include "dealing.hpp"

#include "groups.hpp"
#include "hyoryu/ranks/comm.hpp"

#include <algorithm>
#include <numeric>

namespace hyoryu {

namespace {

// Approximate cost of a message [updates of rows, of 0.1 us each].
constexpr double work_of_message = 2000;
// Owner of a group that every rank advances itself, since it costs less than its part of a message.
constexpr int everyone = -1;

// Expected cost of a cluster from that of the last step; 0 for free flight [updates of rows].
double expected_work(const ContactMemory& memory, const Cluster& cluster)
{
    if (cluster.pairs.empty()) {
        return 0;
    }
    double last = 0;
    for (const int k : cluster.bodies) {
        last += memory.work_of[at(k)];
    }
    return std::max(last, look_work * static_cast<double>(cluster.pairs.size()));
}

// The rank that advances each group, and the work saved: the total less that of the busiest rank.
struct Deal {
    std::vector<int> owner; // of each outcome, or `everyone`
    double saved = 0;       // [updates of rows]
};

// The costliest first, each to the rank that has the least so far (Graham 1969).
Deal deal_out(const ContactMemory& memory, const std::vector<Outcome*>& outcomes, int ranks)
{
    Deal deal;
    std::vector<double> work;
    for (const Outcome* outcome : outcomes) {
        work.push_back(expected_work(memory, outcome->cluster));
    }
    std::vector<std::size_t> order(outcomes.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t k) { return work[k]; });
    deal.owner.assign(outcomes.size(), everyone);
    std::vector<double> load(at(ranks), 0);
    for (const std::size_t k : order) {
        if (work[k] > 0) {
            const auto least = std::ranges::min_element(load);
            deal.owner[k] = static_cast<int>(least - load.begin());
            *least += work[k];
        }
    }
    deal.saved = std::accumulate(load.begin(), load.end(), 0.0) - std::ranges::max(load);
    return deal;
}

// The state of a body after the step.
struct BodyOutcome {
    Vec3 position{0, 0, 0}; // [m]
    Quat orientation = Quat::Identity();
    Vec3 velocity{0, 0, 0};         // [m/s]
    Vec3 angular_momentum{0, 0, 0}; // [kg m2/s]
    Deviation deviation;
    double work = 0; // [updates of rows]
};

BodyOutcome outcome_of(const StepContext& context, int k)
{
    const ContactMemory& memory = context.memory;
    const Body& body = context.rigid.bodies[at(k)];
    const SolidPose& pose = memory.poses[at(k)];
    return {.position = pose.x,
            .orientation = pose.q,
            .velocity = body.velocity,
            .angular_momentum = body.angular_momentum,
            .deviation = memory.deviations[at(k)],
            .work = memory.work_of[at(k)]};
}

void take(const StepContext& context, int k, const BodyOutcome& outcome)
{
    ContactMemory& memory = context.memory;
    Body& body = context.rigid.bodies[at(k)];
    memory.poses[at(k)] = pose_of(outcome.position, outcome.orientation);
    body.velocity = outcome.velocity;
    body.angular_momentum = outcome.angular_momentum;
    memory.work_of[at(k)] = outcome.work;
    memory.deviations[at(k)] = outcome.deviation;
}

void put_outcome(Parcel& parcel, const StepContext& context, const Outcome& outcome)
{
    put(parcel, outcome.jammed);
    put(parcel, outcome.counters);
    put_list(parcel, outcome.log);
    put_list(parcel, outcome.fresh);
    for (const int k : outcome.cluster.bodies) {
        put(parcel, outcome_of(context, k));
    }
}

void take_outcome(Unpacking& from, const StepContext& context, Outcome& outcome)
{
    outcome.jammed = from.take<bool>();
    outcome.counters = from.take<RigidCounters>();
    outcome.log = take_list<Contact>(from);
    outcome.fresh = take_list<Remembered>(from);
    for (const int k : outcome.cluster.bodies) {
        take(context, k, from.take<BodyOutcome>());
    }
    outcome.done = true;
}

// Sends the outcomes of each rank to all others.
void share_outcomes(const StepContext& context, const std::vector<Outcome*>& outcomes,
                    const Deal& deal, Comm& comm)
{
    Parcel own;
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
        if (deal.owner[k] == comm.rank()) {
            put_outcome(own, context, *outcomes[k]);
        }
    }
    const std::vector<Parcel> in = comm.exchange(std::vector<Parcel>(at(comm.size()), own));
    for (int rank = 0; rank < comm.size(); ++rank) {
        Unpacking from(in[at(rank)]);
        for (std::size_t k = 0; k < outcomes.size(); ++k) {
            if (deal.owner[k] == rank && rank != comm.rank()) {
                take_outcome(from, context, *outcomes[k]);
            }
        }
    }
}

// Advances groups that do not meet.
void advance_all(const StepContext& context, const std::vector<Outcome*>& groups,
                 const AdvanceCluster& advance, Comm& comm)
{
    const Deal deal = deal_out(context.memory, groups, comm.size());
    const bool shared = deal.saved > work_of_message;
    for (std::size_t k = 0; k < groups.size(); ++k) {
        if (!shared || deal.owner[k] == everyone || deal.owner[k] == comm.rank()) {
            advance_group(context, *groups[k], advance);
        }
    }
    if (shared) {
        share_outcomes(context, groups, deal, comm);
    }
}

} // namespace

void advance_dealt_out(const StepContext& context, const AdvanceCluster& advance, Comm& comm)
{
    ContactMemory& memory = context.memory;
    std::vector<Splitting> clusters;
    for (const Cluster& cluster : memory.clusters) {
        clusters.push_back(split(context, cluster));
    }
    memory.in_groups = true;
    for (bool any = true; any;) {
        std::vector<Outcome*> groups;
        for (Splitting& cluster : clusters) {
            if (cluster.open) {
                regroup(context, cluster);
            }
            for (Outcome& group : cluster.groups) {
                if (!group.done) {
                    groups.push_back(&group);
                }
            }
        }
        advance_all(context, groups, advance, comm);
        any = false;
        for (Splitting& cluster : clusters) {
            cluster.open = cluster.open && join_met(context, cluster);
            any = any || cluster.open;
        }
    }
    memory.in_groups = false;
    for (const Splitting& cluster : clusters) {
        for (const Outcome& group : cluster.groups) {
            hand_over(context, group);
        }
    }
}

} // namespace hyoryu
