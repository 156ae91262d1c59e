// SPDX-License-Identifier: MIT
// Unlocated (time-stepping) contact steps, for clusters with too many bodies or impacts to locate
// each impact in time.
#include "groups.hpp"

#include "hyoryu/core/parallel.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// Largest rotation of a body in one sub-step [rad].
constexpr double most_turn_of_sub_step = 0.3;
// Largest number of sub-steps of a step, however fast a body spins.
constexpr int most_sub_steps = 2000;
// A contact rests if gravity and loads alone cause its approach speed in this number of sub-steps.
constexpr double sub_steps_of_rest = 2;
// Impact rounds per sub-step, and the effort of each.
constexpr int rounds_of_unlocated = 4;
constexpr Effort impact_effort{.enough = 1e-3, .direct_tries = 0, .sweeps = 40};
// The next step starts from these impulses and corrects their residual. But each sweep transmits a
// load only from course to course: with sixty sweeps at steps of 5 ms a wall of twenty courses
// sinks into itself until it falls, and costs more than a standing one.
constexpr Effort contact_effort{
    .enough = 1e-4, .direct_tries = 0, .sweeps = 500, .updates = 400000};
// Gaps below this are not projected: in a pile the correction of one gap opens others [units].
constexpr double no_gap = 1e-9;
// Largest increase of an overlap in a sub-step [units].
constexpr double deeper_by = 1e-5;
// Work limit for shortening the sub-steps of a cluster because of overlaps [updates of rows]. It
// keeps the cost proportional to the cluster: a body crushed by a moving wall overlaps more however
// short the sub-step, and a large heap has such a place in every step.
constexpr double shortening_work = 4e5;
// Number of pairs that share a list of found contacts, independent of the number of threads.
constexpr Index pairs_per_block = 32;

double fastest_change(const StepContext& context, const Cluster& cluster)
{
    double most = 0;
    for (const int k : cluster.bodies) {
        most = std::max(most, acceleration(context, k).norm());
    }
    return most;
}

// How far a point of the body may move in the sub-step.
double travel(const ContactMemory& memory, int k, const SubStep& sub)
{
    if (k < 0) {
        return sub.h *
               speed_bound(memory.geometry.walls[-1 - k].motion, sub.time, sub.time + sub.h);
    }
    const double spin = memory.responses[k].omega.norm() * memory.geometry.solids[k].reach;
    const double speed = std::max(memory.paths[k].v0.norm(), memory.paths[k].v1.norm());
    return memory.rotors[k].movable ? sub.h * (speed + spin) : 0;
}

void find_all_closing(const StepContext& context, const SubStep& sub)
{
    ContactMemory& memory = context.memory;
    const std::vector<BodyPair>& pairs = sub.cluster.pairs;
    const auto count = static_cast<Index>(pairs.size());
    const Index blocks = (count + pairs_per_block - 1) / pairs_per_block;
    memory.found.resize(std::max(memory.found.size(), static_cast<std::size_t>(blocks)));
    parallel_blocks(0, blocks, [&](Index block) {
        std::vector<Candidate>& found = memory.found[block];
        found.clear();
        const Index last = std::min(count, (block + 1) * pairs_per_block);
        for (Index k = block * pairs_per_block; k < last; ++k) {
            find_closing(context, pairs[k], sub, found);
        }
    });
    memory.candidates.clear();
    for (Index block = 0; block < blocks; ++block) {
        const auto& found = memory.found[block];
        memory.candidates.insert(memory.candidates.end(), found.begin(), found.end());
    }
    double& worst = context.rigid.counters.worst_penetration;
    for (const Candidate& c : memory.candidates) {
        worst = std::max(worst, -c.touch.gap);
    }
}

// Solves the impacts of contacts that close within the sub-step, then plans the motion with the
// contacts that remain.
void plan_unlocated(const StepContext& context, const SubStep& sub)
{
    set_responses(context, sub.cluster);
    predict_free_motion(context, sub);
    find_all_closing(context, sub);
    solve_impacts(context, sub, sub.time); // its residual is corrected by `plan_motion`
    plan_motion(context, sub);
}

// The deepest overlap at the given poses among the pairs without an event search [m].
double deepest(const StepContext& context, const SubStep& sub, const std::vector<SolidPose>& poses,
               double time)
{
    ContactMemory& memory = context.memory;
    const Configuration at = configuration(memory, poses, time);
    double most = 0;
    for (const BodyPair& pair : sub.cluster.pairs) {
        if (sub.arms == Arms::ahead && !exceeds_event_limit(memory, pair.a, pair.b)) {
            continue;
        }
        for (const Candidate& c : look_at(memory, pair, at)) {
            most = std::max(most, -c.touch.gap);
        }
    }
    return most;
}

} // namespace

void find_closing(const StepContext& context, const BodyPair& pair, const SubStep& sub,
                  std::vector<Candidate>& found)
{
    const ContactMemory& memory = context.memory;
    const Configuration now = configuration(memory, memory.poses, sub.time);
    const Configuration later = configuration(memory, memory.end, sub.time + sub.h);
    const double apart = clearly_apart(memory.geometry);
    const double near = apart + travel(memory, pair.a, sub) + travel(memory, pair.b, sub);
    const std::size_t first = found.size();
    find_candidates(pair, now, near, found);
    const double tolerance = context.rigid.settings.contact_tolerance;
    const auto far = [&](Candidate& c) {
        c.closing = c.touch.gap > tolerance && c.touch.gap <= near &&
                    (c.touch.gap <= apart || touch_of(c.feature, later).gap < 0);
        return c.touch.gap > tolerance && !c.closing;
    };
    found.erase(
        std::remove_if(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(), far),
        found.end());
    const bool open = std::all_of(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(),
                                  [&](const Candidate& c) { return c.touch.gap > apart; });
    if (open && has_axis(pair, memory.geometry) && axis_distance(pair, later) > 0) {
        found.resize(first); // they pass each other
    }
}

double sub_step_length(const StepContext& context, const Cluster& cluster, double rest)
{
    const ContactMemory& memory = context.memory;
    double fastest = 0;
    for (const int k : cluster.bodies) {
        if (!turns_unseen(memory.geometry.solids[k])) {
            fastest = std::max(fastest, memory.responses[k].omega.norm());
        }
    }
    const double least = context.dt / most_sub_steps;
    return fastest * rest > most_turn_of_sub_step
               ? std::min(rest, std::max(most_turn_of_sub_step / fastest, least))
               : rest;
}

void find_contacts_with_unlocated(const StepContext& context, const SubStep& sub)
{
    ContactMemory& memory = context.memory;
    predict_free_motion(context, sub);
    memory.candidates.clear();
    memory.work += look_work * static_cast<double>(sub.cluster.pairs.size());
    const Configuration now = configuration(memory, memory.poses, sub.time);
    for (const BodyPair& pair : sub.cluster.pairs) {
        if (exceeds_event_limit(memory, pair.a, pair.b)) {
            find_closing(context, pair, sub, memory.candidates);
            continue;
        }
        const std::span<const Candidate> found = look_at(memory, pair, now);
        memory.candidates.insert(memory.candidates.end(), found.begin(), found.end());
    }
}

bool ends_deep(const StepContext& context, const SubStep& sub)
{
    ContactMemory& memory = context.memory;
    const double after = deepest(context, sub, memory.end, sub.time + sub.h);
    return after > deeper_by * context.rigid.settings.unit &&
           after > deepest(context, sub, memory.poses, sub.time);
}

void advance_unlocated(const StepContext& context, const Cluster& cluster, double done)
{
    ContactMemory& memory = context.memory;
    memory.stepped = true;
    const double change = fastest_change(context, cluster);
    const double enough_work = memory.work + shortening_work;
    double longest = context.dt;
    while (done < context.dt) {
        set_responses(context, cluster);
        const double rest = context.dt - done;
        const double h = std::min(sub_step_length(context, cluster, rest), longest);
        const double slow =
            std::max(context.rigid.settings.resting_speed, sub_steps_of_rest * change * h);
        SubStep sub{cluster,       context.start + done, h,         slow,  rounds_of_unlocated,
                    impact_effort, contact_effort,       Arms::now, no_gap};
        plan_unlocated(context, sub);
        const auto may_be_shorter = [&] {
            return memory.work < enough_work && 0.5 * sub.h >= context.dt / most_sub_steps;
        };
        while (may_be_shorter() && ends_deep(context, sub)) {
            sub.h *= 0.5;
            plan_unlocated(context, sub);
        }
        longest = memory.work < enough_work ? 2 * sub.h : context.dt;
        const WorkOfShare work = work_of_contacts(memory, memory.rows);
        memory.lost -= work.linear + work.square;
        move_to(context, sub, sub.h);
        remember(memory, sub.h);
        find_contacts(context, cluster, sub.time + sub.h); // including unplanned ones
        open_gaps(context, sub, sub.time + sub.h);
        note_motion(context, sub, sub.h);
        done = sub.h < rest ? done + sub.h : context.dt;
    }
}

} // namespace hyoryu
