// SPDX-License-Identifier: MIT
// Motion along the planned paths, and the projection of gaps: position corrections of overlaps.
#include "sub_step.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

constexpr int most_sweeps = 10;
// Overlap up to this depth is corrected at once. A deeper one existed at the start or was not
// located, and is reduced by a share per step so that no body jumps [units].
constexpr double at_once = 1e-5;
constexpr double share_of_deep = 0.2;

void record_resting(ContactMemory& memory, const Persistent& p, double time, double part)
{
    const Feature& f = p.candidate.feature;
    const Touch& touch = p.touches.push;
    const Vec3 impulse = part * p.impulse;
    Contact contact{Contact::Kind::resting, time, f.a, f.b, touch.point, touch.normal};
    contact.effective_mass = p.effective_mass;
    contact.normal_impulse = impulse.dot(touch.normal);
    contact.tangential_impulse = impulse - contact.normal_impulse * touch.normal;
    contact.energy_lost = part * p.dissipated;
    contact.depth = std::max(0.0, -p.candidate.touch.gap);
    memory.resting.push_back({f, contact});
}

void turn_by(SolidPose& pose, const Vec3& w)
{
    pose = pose_of(pose.x, (rotation_by(w) * pose.q).normalized());
}

struct Goal {
    Feature feature;
    double wanted = 0; // gap [m]
    double play = 0;   // by which it may be wider [m]
    double gap = 0;    // at the start [m]

    bool is_met(double now, double no_gap) const
    {
        const double off = now - wanted;
        return std::abs(off) <= no_gap || (off > 0 && off <= play);
    }
};

// Moves both bodies in proportion to their inverse masses until the feature has the wanted gap;
// returns the former deviation.
double close_gap(const StepContext& context, const Goal& goal, double no_gap, double time)
{
    ContactMemory& memory = context.memory;
    const Feature& f = goal.feature;
    const Touch touch = touch_of(f, configuration(memory, memory.poses, time));
    if (goal.is_met(touch.gap, no_gap)) {
        return 0;
    }
    const double off = touch.gap - goal.wanted;
    const Vec3& n = touch.normal;
    const auto arm = [&](int k) { return Vec3((touch.point - memory.poses[k].x).cross(n)); };
    const auto answer = [&](int k) {
        const Vec3 turn = arm(k);
        return n.dot(memory.responses[k].inverse_mass.cwiseProduct(n)) +
               turn.dot(memory.responses[k].inverse_inertia * turn);
    };
    const double K = answer(f.a) + (f.b >= 0 ? answer(f.b) : 0);
    if (K <= 0) {
        return 0;
    }
    const auto move = [&](int k, double lambda) {
        const Vec3 turn = lambda * (memory.responses[k].inverse_inertia * arm(k));
        memory.poses[k].x += lambda * memory.responses[k].inverse_mass.cwiseProduct(n);
        turn_by(memory.poses[k], turn);
    };
    move(f.a, -off / K);
    if (f.b >= 0) {
        move(f.b, off / K);
    }
    return std::abs(off);
}

// The event search leaves gaps closer to zero than this [units].
constexpr double overlapping = -1e-10;

double aim(double gap, double unit)
{
    return gap < -at_once * unit ? (1 - share_of_deep) * gap : 0.0;
}

// A pile may have more pressed contacts than degrees of freedom. Not all gaps can then be zero, and
// a tenth of the contact tolerance is left open [units].
constexpr double play_of_a_pile = 1e-8;

// Gaps of pressed contacts are opened or closed to zero, up to that play; all others are only
// opened.
std::vector<Goal> goals(const StepContext& context, double time)
{
    ContactMemory& memory = context.memory;
    const Configuration now = configuration(memory, memory.poses, time);
    const double unit = context.rigid.settings.unit;
    const bool pile = memory.persistent.size() > contacts_of_a_pile;
    const double play = pile ? play_of_a_pile * unit : 0;
    std::vector<Goal> list;
    for (const Persistent& p : memory.persistent) {
        const Touch touch = touch_of(p.candidate.feature, now);
        if (p.impulse.dot(p.touches.push.normal) > 0 && std::abs(touch.gap) < at_once * unit) {
            list.push_back({.feature = p.candidate.feature, .play = play, .gap = touch.gap});
        }
    }
    std::vector<Feature>& pressed = memory.pressed;
    pressed.clear();
    for (const Goal& goal : list) {
        pressed.push_back(goal.feature);
    }
    std::sort(pressed.begin(), pressed.end());
    for (const Candidate& c : memory.candidates) {
        if (c.touch.gap < overlapping * unit &&
            !std::binary_search(pressed.begin(), pressed.end(), c.feature)) {
            list.push_back({.feature = c.feature,
                            .wanted = aim(c.touch.gap, unit),
                            .play = infinity,
                            .gap = c.touch.gap});
        }
    }
    return list;
}

// Passes of the opening; the second corrects the effect of finite rotations.
constexpr int opening_passes = 2;
// An overlap is opened to within a ten-thousandth of the deepest one that is corrected at once. As
// sweeps converge slowly if a light body lies under a heavy one, few rows are solved exactly.
constexpr Effort opening_effort{.enough = 1e-4, .direct_tries = 0, .sweeps = 60, .pivoted = 64};
// If walls leave no room, no displacement opens all contacts: the exact solution is then unbounded,
// and sweeps are used instead, which distribute the overlap.
constexpr Effort swept_opening{.enough = 1e-4, .direct_tries = 0, .sweeps = 60};
constexpr double widest_move = 10; // times the widest opening

// Sets up the contacts as frictionless rows in which velocities stand for displacements, all zero
// at first; the targets open the gaps.
void lay_out_opening(const StepContext& context, const SubStep& sub, double time)
{
    ContactMemory& memory = context.memory;
    const Configuration now = configuration(memory, memory.poses, time);
    set_responses(context, sub.cluster);
    for (const int k : sub.cluster.bodies) {
        memory.responses[k].v.setZero();
        memory.responses[k].omega.setZero();
    }
    memory.rows.clear();
    for (const Candidate& c : memory.candidates) {
        const Touch touch = touch_of(c.feature, now);
        Row row;
        row.a = c.feature.a;
        row.b = std::max(c.feature.b, -1);
        const Vec3 xa = memory.poses[row.a].x;
        const Vec3 xb = row.b >= 0 ? memory.poses[row.b].x : xa;
        complete(row, {touch, touch}, {xa, xb, xa, xb}, memory.responses,
                 context.rigid.settings.dimensions);
        if (row.cone.K(0, 0) > 0) {
            row.target = aim(c.touch.gap, context.rigid.settings.unit) - touch.gap;
            memory.rows.push_back(row);
        }
    }
}

bool goes_too_far(const ContactMemory& memory, const Cluster& cluster)
{
    double widest = 0;
    for (const Row& row : memory.rows) {
        widest = std::max(widest, row.target);
    }
    return std::ranges::any_of(cluster.bodies, [&](int k) {
        const Response& moved = memory.responses[k];
        const double turned = memory.geometry.solids[k].reach * moved.omega.norm();
        return moved.v.norm() + turned > widest_move * widest;
    });
}

// Work of the displacements in `responses` against gravity and loads, plus the change of rotational
// energy at constant angular momentum [J].
double work_of_opening(const StepContext& context, const Cluster& cluster)
{
    double work = 0;
    for (const int k : cluster.bodies) {
        const Response& moved = context.memory.responses[k];
        const Body& body = context.rigid.bodies[k];
        const Vec3 omega = moved.inverse_inertia * body.angular_momentum;
        work -= body.mass.mass * acceleration(context, k).dot(moved.v);
        work += moved.omega.dot(omega.cross(body.angular_momentum) - context.loads[k].torque);
    }
    return work;
}

// A deeper overlap existed at the start; a step of 5 ms leaves less [units].
constexpr double from_before = 1e-3;

// The share of displacements with the cost `work` that the energy dissipated in this step and the
// amount `given` allow [J]; 1 if an overlap existed before the step.
double share_of_opening(const StepContext& context, double work, double given)
{
    ContactMemory& memory = context.memory;
    const double unit = context.rigid.settings.unit;
    const double paid = std::max(memory.lost + given, 0.0);
    const bool free =
        work <= paid || std::ranges::any_of(memory.candidates, [&](const Candidate& c) {
            return c.touch.gap < -from_before * unit;
        });
    const double share = free ? 1 : paid / work;
    memory.lost -= share * work;
    return share;
}

// Work of the displacement from the poses `trial` against gravity and loads, plus the change of
// rotational energy at constant angular momentum [J].
double work_from(const StepContext& context, const Cluster& cluster)
{
    const ContactMemory& memory = context.memory;
    double work = 0;
    for (const int k : cluster.bodies) {
        const Body& body = context.rigid.bodies[k];
        const Rotor& rotor = memory.rotors[k];
        if (!rotor.movable) {
            continue;
        }
        const SolidPose& from = memory.trial[k];
        const SolidPose& to = memory.poses[k];
        work -= body.mass.mass * acceleration(context, k).dot(to.x - from.x);
        if (rotor.free_axes > 0) {
            const Vec3& L = body.angular_momentum;
            work +=
                0.5 * L.dot(inverse_inertia(rotor, to.R) * L - inverse_inertia(rotor, from.R) * L);
            const Vec3 turn = 2 * (to.q * from.q.conjugate()).vec(); // of a small angle
            work -= context.loads[k].torque.dot(turn);
        }
    }
    return work;
}

// A body at rest dissipates no energy that could open its overlap. It may rise by this in a
// sub-step, which removes a micrometre in a thousand sub-steps [units].
constexpr double creep = 1e-9;

double work_of_creep(const StepContext& context, const Cluster& cluster)
{
    double weight = 0;
    for (const int k : cluster.bodies) {
        const bool movable = context.memory.rotors[k].movable;
        weight += movable ? context.rigid.bodies[k].mass.mass * acceleration(context, k).norm() : 0;
    }
    return creep * context.rigid.settings.unit * weight;
}

// Whether contacts overlapped at the start of the sub-step by more than the event search leaves, as
// after unlocated sub-steps.
bool overlapped_before(const StepContext& context)
{
    constexpr double by_location = 1e-9; // [units]
    const double least = -by_location * context.rigid.settings.unit;
    return std::ranges::any_of(context.memory.persistent,
                               [&](const Persistent& p) { return p.candidate.touch.gap < least; });
}

// Limits the displacement from `trial` to the share that the energy dissipated in this step allows.
// The changes of gaps in the sub-step itself were checked by `gains_energy`.
void pay_for_projection(const StepContext& context, const SubStep& sub)
{
    ContactMemory& memory = context.memory;
    const Cluster& cluster = sub.cluster;
    const double work = work_from(context, cluster);
    if (!overlapped_before(context)) {
        memory.lost -= work;
        return;
    }
    const double share = share_of_opening(context, work, work_of_creep(context, cluster));
    for (const int k : cluster.bodies) {
        const SolidPose& from = memory.trial[k];
        const SolidPose& to = memory.poses[k];
        memory.poses[k] = pose_of(from.x + share * (to.x - from.x), from.q.slerp(share, to.q));
    }
}

void update_gaps(ContactMemory& memory, double time)
{
    const Configuration now = configuration(memory, memory.poses, time);
    for (Candidate& candidate : memory.candidates) {
        candidate.touch = touch_of(candidate.feature, now);
    }
}

} // namespace

void open_gaps(const StepContext& context, const SubStep& sub, double time)
{
    ContactMemory& memory = context.memory;
    const double no_gap = sub.no_gap * context.rigid.settings.unit;
    const auto closed = [&](const Row& row) { return row.target > no_gap; };
    for (int pass = 0; pass < opening_passes; ++pass) {
        lay_out_opening(context, sub, time);
        if (std::ranges::none_of(memory.rows, closed)) {
            break;
        }
        solve_islands(memory.rows, memory, opening_effort);
        if (goes_too_far(memory, sub.cluster)) {
            lay_out_opening(context, sub, time);
            solve_islands(memory.rows, memory, swept_opening);
        }
        const double share = share_of_opening(context, work_of_opening(context, sub.cluster), 0);
        for (const int k : sub.cluster.bodies) {
            memory.poses[k].x += share * memory.responses[k].v;
            turn_by(memory.poses[k], share * memory.responses[k].omega);
        }
    }
    update_gaps(memory, time);
}

void move_to(const StepContext& context, const SubStep& sub, double s)
{
    ContactMemory& memory = context.memory;
    const double part = sub.h > 0 ? s / sub.h : 0;
    for (const int k : sub.cluster.bodies) {
        const Path& path = memory.paths[k];
        Body& body = context.rigid.bodies[k];
        memory.poses[k] = s < sub.h ? pose_at(path, memory.rotors[k], s) : memory.end[k];
        body.velocity = path.v0 + part * (path.v1 - path.v0);
        body.angular_momentum = path.L0 + part * (path.L1 - path.L0);
    }
    for (const Persistent& p : memory.persistent) {
        record_resting(memory, p, sub.time + s, part);
    }
}

void project_gaps(const StepContext& context, const SubStep& sub, double time)
{
    ContactMemory& memory = context.memory;
    std::vector<Goal> list = goals(context, time);
    const double no_gap = sub.no_gap * context.rigid.settings.unit;
    if (std::ranges::all_of(list,
                            [&](const Goal& goal) { return goal.is_met(goal.gap, no_gap); })) {
        return;
    }
    set_responses(context, sub.cluster);
    for (const int k : sub.cluster.bodies) {
        memory.trial[k] = memory.poses[k];
    }
    const auto sweep = [&] {
        double off = infinity;
        for (int k = 0; k < most_sweeps && off > no_gap; ++k) {
            off = 0;
            for (const Goal& goal : list) {
                off = std::max(off, close_gap(context, goal, no_gap, time));
            }
        }
        return off;
    };
    if (sweep() > no_gap && memory.persistent.size() > contacts_of_a_pile) {
        for (Goal& goal : list) { // open gaps are better than overlaps
            goal.play = infinity;
        }
        sweep();
    }
    pay_for_projection(context, sub);
    update_gaps(memory, time);
}

} // namespace hyoryu
