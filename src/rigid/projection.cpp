// SPDX-License-Identifier: MIT
// Moving along the paths, and the gap projection.
#include "sub_step.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

constexpr int most_sweeps = 10;
// Overlap that is put right at once; what is deeper was there from the start or was not located,
// and goes by a share a step so that nothing jumps [units].
constexpr double at_once = 1e-5;
constexpr double share_of_deep = 0.2;

void book_resting(ContactMemory& memory, const Persistent& p, double time, double part)
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
};

// Moves both bodies, shared by inverse mass, until the gap of the feature is the wanted one;
// returns how far it was off.
double close_gap(const StepContext& context, const Goal& goal, double no_gap, double time)
{
    ContactMemory& memory = context.memory;
    const Feature& f = goal.feature;
    const Touch touch = touch_of(f, configuration(memory, memory.poses, time));
    const double off = touch.gap - goal.wanted;
    if (std::abs(off) <= no_gap || (off > 0 && off <= goal.play)) {
        return 0;
    }
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

// An event leaves a contact nearer to zero than this [units].
constexpr double overlapping = -1e-10;

double aim(double gap, double unit)
{
    return gap < -at_once * unit ? (1 - share_of_deep) * gap : 0.0;
}

// A pile may press more contacts than its bodies have freedoms; then not all can have a gap of
// zero, and a tenth of what passes for contact is left open [units].
constexpr double play_of_a_pile = 1e-8;

// Pressed contacts close in both senses, but for that play; all others only open. Unlocated, all
// only open, and what is open closes by itself.
std::vector<Goal> goals(const StepContext& context, const SubStep& sub, double time)
{
    ContactMemory& memory = context.memory;
    const Configuration now = configuration(memory, memory.poses, time);
    const double unit = context.rigid.settings.unit;
    const double play = sub.arms == Arms::now                           ? infinity
                        : memory.persistent.size() > contacts_of_a_pile ? play_of_a_pile * unit
                                                                        : 0;
    std::vector<Goal> list;
    for (const Persistent& p : memory.persistent) {
        const Touch touch = touch_of(p.candidate.feature, now);
        if (p.impulse.dot(p.touches.push.normal) > 0 && std::abs(touch.gap) < at_once * unit) {
            list.push_back({.feature = p.candidate.feature, .play = play});
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
            list.push_back(
                {.feature = c.feature, .wanted = aim(c.touch.gap, unit), .play = infinity});
        }
    }
    return list;
}

} // namespace

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
        book_resting(memory, p, sub.time + s, part);
    }
}

void project_gaps(const StepContext& context, const SubStep& sub, double time)
{
    ContactMemory& memory = context.memory;
    std::vector<Goal> list = goals(context, sub, time);
    if (list.empty()) {
        return;
    }
    set_responses(context, sub.cluster);
    const double no_gap = sub.no_gap * context.rigid.settings.unit;
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
        for (Goal& goal : list) { // rather wide than overlapping
            goal.play = infinity;
        }
        sweep();
    }
    const Configuration now = configuration(memory, memory.poses, time);
    for (Candidate& candidate : memory.candidates) {
        candidate.touch = touch_of(candidate.feature, now);
    }
}

} // namespace hyoryu
