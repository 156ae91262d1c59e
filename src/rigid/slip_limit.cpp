// SPDX-License-Identifier: MIT
// The end of sliding within a sub-step. Friction jumps there, and a step across it would be of
// first order: the sub-step ends where the first contact stops sliding.
#include "sub_step.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// The sub-step ends this part before the slip does, so that the direction of sliding holds in it;
// more if that turns out to be too near.
constexpr double short_of = 1e-6;
constexpr double more = 30;
constexpr int tries_of_slip = 8;
// Sliding that stops within this part of the sub-step stops at once; what it loses till there tells
// when other sliding will.
constexpr double shortest_slide = 1.0 / 256;
// A rest of sliding of this part of the sub-step is left to the next one.
constexpr double settled = 1e-4;
// Events of a body in this step beyond which it rattles: what slides between two of its impacts
// does so for a moment, and the impacts matter more than where in it that stops.
constexpr int rattling_events = 3;
// Round-off of a slip that has stopped, as a part of what it was.
constexpr double stopped = 1e-9;

bool slides_faster(const Persistent& p, double slow)
{
    return p.slip_before.norm() > slow && p.impulse.squaredNorm() > 0;
}

// The time at which the first contact stops sliding, if its speed goes on as it does in `h`.
double extrapolated(const std::vector<Persistent>& contacts, double slow, double h)
{
    double first = infinity;
    for (const Persistent& p : contacts) {
        const double before = p.slip_before.squaredNorm();
        const double lost = before - p.slip_before.dot(p.slip_after);
        if (slides_faster(p, slow) && lost > 0) {
            first = std::min(first, h * before / lost);
        }
    }
    return first;
}

bool stops(const std::vector<Persistent>& contacts, double slow)
{
    return std::any_of(contacts.begin(), contacts.end(), [&](const Persistent& p) {
        return slides_faster(p, slow) &&
               p.slip_before.dot(p.slip_after) <= stopped * p.slip_before.squaredNorm();
    });
}

bool rattles(const StepContext& context, const SubStep& sub)
{
    return std::ranges::any_of(sub.cluster.bodies,
                               [&](int k) { return context.memory.events[k] > rattling_events; });
}

// What stops at once stops by an impulse: there is no time before it.
void plan_to_the_end(const StepContext& context, SubStep& sub, double whole)
{
    sub.slip = Slip::end;
    sub.h = whole;
    plan_again(context, sub);
}

} // namespace

void end_with_slip(const StepContext& context, SubStep& sub)
{
    std::vector<Persistent>& contacts = context.memory.persistent;
    const double slow = no_slip * std::sqrt(context.rigid.settings.unit);
    if (contacts.size() > contacts_of_a_pile || rattles(context, sub) || !stops(contacts, slow)) {
        return;
    }
    const double whole = sub.h;
    sub.h = shortest_slide * whole;
    plan_again(context, sub);
    if (stops(contacts, slow)) {
        plan_to_the_end(context, sub, whole);
        return;
    }
    double end = extrapolated(contacts, slow, sub.h);
    bool known = end < whole; // whether `end` is extrapolated
    end = known ? end : 0.5 * whole;
    double margin = short_of;
    for (int k = 0; k < tries_of_slip; ++k) {
        sub.h = known ? (1 - margin) * end : end;
        plan_again(context, sub);
        if (stops(contacts, slow)) {
            end = known ? end : 0.5 * end;
            margin *= known ? more : 1;
            if (margin >= 1) {
                break; // no time before it that is worth a sub-step
            }
            continue;
        }
        if (known && margin > short_of) {
            return; // it stops a little later
        }
        end = std::min(extrapolated(contacts, slow, sub.h), whole);
        known = true;
        if (end - sub.h <= settled * whole) {
            return;
        }
    }
    plan_to_the_end(context, sub, whole);
}

} // namespace hyoryu
