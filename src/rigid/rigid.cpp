// SPDX-License-Identifier: MIT
// The step of the rigid layer: broad phase, then each cluster by located or unlocated sub-steps.
#include "rigid/motion/broad_phase.hpp"
#include "rigid/motion/dealing.hpp"
#include "rigid/motion/groups.hpp"
#include "rigid/motion/sub_step.hpp"
#include "rigid/penalty/penalty.hpp"

#include "hyoryu/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hyoryu {

namespace {

// An impact needs n rounds to pass through a chain of n bodies.
constexpr int rounds_of_impacts = 50;
// A sub-step of n bodies in contact costs about this times n^1.5, mostly for the elimination in a
// heap [updates of rows].
constexpr double work_of_sub_step = 8;

void fly(const StepContext& context, const Cluster& cluster)
{
    const SubStep sub{cluster, context.start, context.dt};
    context.memory.candidates.clear();
    plan_motion(context, sub);
    move_to(context, sub, sub.h);
    note_motion(context, sub, sub.h);
}

// Both bodies of every contact that closed count the event. A body that does not move counts none,
// as a wall: it may touch bodies of several groups, which must not see each other's events.
void count_event(const StepContext& context)
{
    ContactMemory& memory = context.memory;
    ++context.rigid.counters.events;
    const auto count = [&](int body) {
        if (body >= 0 && memory.rotors[body].movable) {
            ++memory.events[body];
        }
    };
    for (const Candidate& c : memory.candidates) {
        if (c.touch.gap <= context.rigid.settings.contact_tolerance) {
            count(c.feature.a);
            count(c.feature.b);
        }
    }
}

// Adds up what each persistent contact did in all sub-steps, by the normal of the first.
void log_resting(const StepContext& context)
{
    const std::vector<Resting>& resting = context.memory.resting;
    std::vector<std::size_t>& order = context.memory.order;
    order.resize(resting.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::ranges::sort(order, [&](std::size_t k, std::size_t m) {
        const auto by_feature = resting[k].feature <=> resting[m].feature;
        return by_feature != 0 ? by_feature < 0 : k < m;
    });
    for (std::size_t k = 0; k < order.size(); ++k) {
        Contact contact = resting[order[k]].contact;
        contact.located = !context.memory.stepped;
        if (k == 0 || resting[order[k]].feature != resting[order[k - 1]].feature) {
            context.log.push_back(contact);
            continue;
        }
        Contact& sum = context.log.back();
        const Vec3 impulse = contact.normal_impulse * contact.normal + contact.tangential_impulse;
        sum.normal_impulse += impulse.dot(sum.normal);
        sum.tangential_impulse += impulse - impulse.dot(sum.normal) * sum.normal;
        sum.energy_lost += contact.energy_lost;
        sum.depth = std::max(sum.depth, contact.depth);
    }
    context.memory.resting.clear();
}

// Hands the cluster's results over: resting contacts to the log, forces to the next step.
void close_cluster(const StepContext& context)
{
    ContactMemory& memory = context.memory;
    log_resting(context);
    memory.fresh.insert(memory.fresh.end(), memory.recent.begin(), memory.recent.end());
    memory.recent.clear();
}

void close_step(Rigid& rigid)
{
    ContactMemory& memory = *rigid.memory;
    sort_by_feature(memory.fresh);
    memory.forces.swap(memory.fresh);
    for (std::size_t k = 0; k < rigid.bodies.size(); ++k) {
        if (memory.rotors[k].movable) {
            rigid.bodies[k].position = memory.poses[k].x;
            rigid.bodies[k].orientation = memory.poses[k].q;
        }
    }
    rigid.counters.capped_steps += memory.jammed ? 1 : 0;
}

// Plans the motion over the sub-step, which is shortened if a contact turns too far or stops
// sliding.
void plan_located(const StepContext& context, SubStep& sub, double rest)
{
    if (context.memory.stepped) {
        find_contacts_with_unlocated(context, sub);
    }
    sub.slip = Slip::mean;
    plan_motion(context, sub);
    end_with_part(context, sub, rest);
    end_with_turn(context, sub);
    end_with_slip(context, sub);
}

bool needs_halving(const StepContext& context, const SubStep& sub)
{
    return (context.memory.stepped && ends_deep(context, sub)) || contacts_sink(context, sub) ||
           gains_energy(context, sub);
}

// Advances with impacts located in time until the step ends or locating has cost too much; returns
// the time reached within the step.
double locate_impacts(const StepContext& context, const Cluster& cluster)
{
    const double slow = context.rigid.settings.resting_speed;
    double done = 0;
    find_contacts(context, cluster, context.start);
    double& worst = context.rigid.counters.worst_residual;
    const SubStep start{cluster, context.start, 0, slow, rounds_of_impacts};
    worst = std::max(worst, solve_impacts(context, start, context.start));
    while (done < context.dt && is_worth_locating(context.memory)) {
        const double rest = context.dt - done;
        double h =
            std::min(sub_step_length(context, cluster, rest), part_on_contacts(context, rest));
        SubStep sub{cluster, context.start + done, h, slow, rounds_of_impacts};
        plan_located(context, sub, rest);
        for (int k = 0; k < halvings && needs_halving(context, sub); ++k) {
            h = 0.5 * sub.h;
            sub.h = h;
            set_responses(context, cluster);
            plan_located(context, sub, rest);
        }
        const double s = first_event(context, sub);
        const double now = sub.time + s;
        move_to(context, sub, s);
        context.memory.lost += taken_by_contacts(context, sub, s);
        remember(context.memory, sub.h);
        find_contacts(context, cluster, now);
        project_gaps(context, sub, now);
        note_motion(context, sub, s);
        if (s < sub.h) {
            count_event(context);
        }
        if (s < h) {
            lower_event_limit(context.memory, cluster);
        }
        worst = std::max(worst, solve_impacts(context, sub, now));
        done = s < rest ? done + s : context.dt;
    }
    return done;
}

void advance(const StepContext& context, const Cluster& cluster)
{
    ContactMemory& memory = context.memory;
    memory.known = memory.forces;
    memory.stepped = false;
    memory.event_limit = event_limit;
    memory.work = 0;
    memory.lost = 0;
    memory.worth = located_work(context, cluster);
    const double once = work_of_sub_step * std::pow(cluster.bodies.size(), 1.5);
    const double done = once > memory.worth ? 0 : locate_impacts(context, cluster);
    if (done < context.dt) {
        advance_unlocated(context, cluster, done);
    }
    close_cluster(context);
    memory.jammed = memory.jammed || memory.stepped;
    for (const int k : cluster.bodies) {
        memory.work_of[k] = memory.work / static_cast<double>(cluster.bodies.size());
    }
}

void advance_or_fly(const StepContext& context, const Cluster& cluster)
{
    if (cluster.pairs.empty()) {
        fly(context, cluster);
    } else {
        advance(context, cluster);
    }
}

} // namespace

Rigid::Rigid() = default;
Rigid::~Rigid() = default;
Rigid::Rigid(Rigid&&) noexcept = default;
Rigid& Rigid::operator=(Rigid&&) noexcept = default;

void step(Rigid& rigid, double time, double dt, std::span<const Wrench> loads,
          std::vector<Contact>& log, Comm* comm)
{
    expects(loads.size() == rigid.bodies.size());
    prepare(rigid);
    const StepContext context{rigid, *rigid.memory, loads, log, time, dt};
    if (rigid.penalty) {
        step_by_penalty(context);
        close_step(rigid);
        return;
    }
    find_clusters(context);
    keep_cache(*rigid.memory);
    if (comm == nullptr) {
        for (const Cluster& cluster : context.memory.clusters) {
            if (cluster.bodies.size() == 1) {
                advance_or_fly(context, cluster);
            } else {
                advance_in_groups(context, cluster, advance_or_fly);
            }
        }
    } else {
        advance_dealt_out(context, advance_or_fly, *comm);
    }
    close_step(rigid);
}

double bounding_radius(const Body& body, int dimensions)
{
    return solid_of(body.shape, dimensions).reach;
}

double inner_radius(const Body& body, int dimensions)
{
    return solid_of(body.shape, dimensions).thickness;
}

double overlap(const Rigid& rigid, int a, int b, double time)
{
    Geometry geometry{.unit = rigid.settings.unit};
    std::vector<SolidPose> poses;
    const int dimensions = rigid.settings.dimensions;
    const auto add_body = [&](int k) {
        const Body& body = rigid.bodies[k];
        geometry.solids.push_back(solid_of(body.shape, dimensions));
        poses.push_back(pose_of(body.position, body.orientation));
    };
    add_body(a);
    if (b >= 0) {
        add_body(b);
    } else {
        geometry.walls.push_back(wall_of(rigid.boundaries[-1 - b], dimensions));
    }
    const BodyPair pair{0, b >= 0 ? 1 : -1};
    const Configuration at{geometry, poses, time};
    if (has_axis(pair, geometry)) {
        return -axis_distance(pair, at);
    }
    std::vector<Candidate> found;
    find_candidates(pair, at, clearly_apart(geometry), found);
    double deepest = -infinity;
    for (const Candidate& candidate : found) {
        deepest = std::max(deepest, -candidate.touch.gap);
    }
    return deepest;
}

} // namespace hyoryu
