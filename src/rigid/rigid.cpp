// SPDX-License-Identifier: MIT
// The step of the rigid layer.
#include "broad_phase.hpp"
#include "sub_step.hpp"

#include "hyoryu/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Rotation of a body in one sub-step at most [rad].
constexpr double most_turn = 0.3;
// Sub-steps of a cluster after which the rest of the step goes without events.
constexpr int most_sub_steps = 2000;

// Short enough that no body turns by more than the most; a ball looks the same however it turns.
double sub_step_length(const StepContext& context, const Cluster& cluster, double rest)
{
    const ContactMemory& memory = context.memory;
    double fastest = 0;
    for (const int k : cluster.bodies) {
        if (memory.geometry.solids[k].form != Form::ball) {
            fastest = std::max(fastest, memory.responses[k].omega.norm());
        }
    }
    return fastest * rest > most_turn ? most_turn / fastest : rest;
}

void fly(const StepContext& context, const Cluster& cluster)
{
    const SubStep sub{cluster, context.start, context.dt};
    context.memory.candidates.clear();
    plan_motion(context, sub);
    move_to(context, sub, sub.h);
}

// Both bodies of every contact that closed count the event.
void count_event(const StepContext& context)
{
    ContactMemory& memory = context.memory;
    ++context.rigid.counters.events;
    for (const Candidate& c : memory.candidates) {
        if (!c.beyond && c.touch.gap <= context.rigid.settings.contact_tolerance) {
            ++memory.events[c.feature.a];
            if (c.feature.b >= 0) {
                ++memory.events[c.feature.b];
            }
        }
    }
}

void sort(std::vector<Remembered>& forces)
{
    std::sort(forces.begin(), forces.end(),
              [](const Remembered& a, const Remembered& b) { return a.feature < b.feature; });
}

// The forces of the persistent contacts, for the warm start of what follows.
void remember(ContactMemory& memory, double h)
{
    memory.recent.clear();
    for (const Persistent& p : memory.persistent) {
        memory.recent.push_back({p.candidate.feature, p.impulse / h});
    }
    sort(memory.recent);
    memory.known = memory.recent;
}

// Hands the cluster's results over: resting contacts to the log, forces to the next step.
void close_cluster(const StepContext& context)
{
    ContactMemory& memory = context.memory;
    context.log.insert(context.log.end(), memory.resting.begin(), memory.resting.end());
    memory.resting.clear();
    memory.resting_features.clear();
    memory.fresh.insert(memory.fresh.end(), memory.recent.begin(), memory.recent.end());
    memory.recent.clear();
}

void close_step(Rigid& rigid)
{
    ContactMemory& memory = *rigid.memory;
    sort(memory.fresh);
    memory.forces.swap(memory.fresh);
    for (std::size_t k = 0; k < rigid.bodies.size(); ++k) {
        if (memory.rotors[k].movable) {
            rigid.bodies[k].position = memory.poses[k].x;
            rigid.bodies[k].orientation = memory.poses[k].q;
        }
    }
    const bool capped = std::any_of(memory.events.begin(), memory.events.end(),
                                    [](int events) { return events > event_limit; });
    rigid.counters.capped_steps += capped ? 1 : 0;
}

void advance(const StepContext& context, const Cluster& cluster)
{
    ContactMemory& memory = context.memory;
    double done = 0;
    memory.known = memory.forces;
    find_contacts(context, cluster, context.start);
    solve_impacts(context, cluster, context.start);
    for (int count = 0; done < context.dt; ++count) {
        const bool located = count < most_sub_steps;
        const double rest = context.dt - done;
        const double h = located ? sub_step_length(context, cluster, rest) : rest;
        const SubStep sub{cluster, context.start + done, h};
        plan_motion(context, sub);
        const double s = located ? first_event(context, sub) : h;
        const double now = sub.time + s;
        move_to(context, sub, s);
        remember(memory, h);
        find_contacts(context, cluster, now);
        project_gaps(context, sub, now);
        if (s < sub.h) {
            count_event(context);
        }
        solve_impacts(context, cluster, now);
        done = s < rest ? done + s : context.dt;
    }
    close_cluster(context);
}

} // namespace

Rigid::Rigid() = default;
Rigid::~Rigid() = default;
Rigid::Rigid(Rigid&&) noexcept = default;
Rigid& Rigid::operator=(Rigid&&) noexcept = default;

void step(Rigid& rigid, double time, double dt, std::span<const Wrench> loads,
          std::vector<Contact>& log)
{
    expects(loads.size() == rigid.bodies.size());
    prepare(rigid);
    const StepContext context{rigid, *rigid.memory, loads, log, time, dt};
    find_clusters(context);
    for (const Cluster& cluster : context.memory.clusters) {
        if (cluster.pairs.empty()) {
            fly(context, cluster);
        } else {
            advance(context, cluster);
        }
    }
    close_step(rigid);
}

double overlap(const Rigid& rigid, int a, int b, double time)
{
    Geometry geometry;
    std::vector<Pose> poses;
    const int dimensions = rigid.settings.dimensions;
    geometry.solids.resize(rigid.bodies.size());
    geometry.walls.resize(rigid.boundaries.size());
    for (const Body& body : rigid.bodies) {
        poses.push_back(pose_of(body.position, body.orientation));
    }
    const auto add_body = [&](int k) {
        geometry.solids[k] = solid_of(rigid.bodies[k].shape, dimensions);
    };
    add_body(a);
    if (b >= 0) {
        add_body(b);
    } else {
        geometry.walls[-1 - b] = wall_of(rigid.boundaries[-1 - b], dimensions);
    }
    const Configuration at{geometry, poses, time};
    if (has_axis({a, b}, geometry)) {
        return -axis_distance({a, b}, at);
    }
    std::vector<Candidate> found;
    find_candidates({a, b}, at, found);
    double deepest = -infinity;
    for (const Candidate& candidate : found) {
        deepest = std::max(deepest, candidate.beyond ? -infinity : -candidate.touch.gap);
    }
    return deepest;
}

} // namespace hyoryu
