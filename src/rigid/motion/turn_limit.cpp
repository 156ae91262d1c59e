// SPDX-License-Identifier: MIT
// Limits of the sub-step for bodies that turn on their contacts. The contact point of two rods that
// cross at a small angle moves along them much faster than they turn.
#include "sub_step.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// A body that turns on a contact is driven by a force that turns with it; this is the largest error
// of the scheme. A third of the step reduces it to a ninth.
constexpr double parts_of_step = 3;
// Tolerance for round-off in the number of parts.
constexpr double part_tolerance = 1e-9;

// Largest turn of the normal between two curves in a sub-step. Beyond it the contact point cannot
// be predicted and rods penetrate each other [rad].
constexpr double most_turn = 0.01;
constexpr double short_of_turn = 0.8;
constexpr double most_shortening = 0.1;
constexpr int tries_of_turn = 8;

// Largest increase of the overlap of a contact in a sub-step [units].
constexpr double shallow = 2e-6;

// The largest turn of a normal between two curves within the sub-step [rad].
double largest_turn(const std::vector<Persistent>& contacts)
{
    double largest = 0;
    for (const Persistent& p : contacts) {
        const FeatureKind kind = p.candidate.feature.kind;
        if (kind == FeatureKind::side_line || kind == FeatureKind::rim_line ||
            kind == FeatureKind::rim_rim) {
            largest = std::max(largest, (p.touches.see.normal - p.candidate.touch.normal).norm());
        }
    }
    return largest;
}

} // namespace

double part_on_contacts(const StepContext& context, double rest)
{
    const ContactMemory& memory = context.memory;
    const RigidSettings& settings = context.rigid.settings;
    // by speed, not by the angle per step, so that the scheme does not depend on the step
    const auto turns = [&](int k) {
        return k >= 0 && !turns_unseen(memory.geometry.solids[k]) &&
               memory.responses[k].omega.norm() * memory.geometry.solids[k].reach >
                   settings.resting_speed;
    };
    std::size_t touching = 0;
    bool any = false;
    for (const Candidate& c : memory.candidates) {
        if (c.touch.gap <= settings.contact_tolerance) {
            ++touching;
            any = any || turns(c.feature.a) || turns(c.feature.b);
        }
    }
    if (!any || touching > contacts_of_a_pile) {
        return rest;
    }
    const double parts = std::ceil(parts_of_step * rest / context.dt - part_tolerance);
    return rest / std::max(parts, 1.0);
}

void end_with_part(const StepContext& context, SubStep& sub, double rest)
{
    const double part = part_on_contacts(context, rest);
    if (part < sub.h) {
        sub.h = part;
        plan_again(context, sub);
    }
}

bool contacts_sink(const StepContext& context, const SubStep& sub)
{
    const ContactMemory& memory = context.memory;
    const Configuration end = configuration(memory, memory.end, sub.time + sub.h);
    return std::ranges::any_of(memory.persistent, [&](const Persistent& p) {
        const double least = std::min(p.candidate.touch.gap, 0.0) - shallow * memory.geometry.unit;
        return touch_of(p.candidate.feature, end).gap < least;
    });
}

void end_with_turn(const StepContext& context, SubStep& sub)
{
    for (int k = 0; k < tries_of_turn; ++k) {
        const double turn = largest_turn(context.memory.persistent);
        if (turn <= most_turn) {
            return;
        }
        sub.h *= std::max(most_shortening, short_of_turn * most_turn / turn);
        plan_again(context, sub);
    }
}

} // namespace hyoryu
