// SPDX-License-Identifier: MIT
// Detects the end of sliding within a sub-step. Friction is discontinuous there, and a step across
// it would be of first order: the sub-step therefore ends when the first contact stops sliding.
#include "sub_step.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// The sub-step ends earlier than the slip by this part, so that the direction of sliding is defined
// throughout; the margin grows by `more` if it proves too small.
constexpr double short_of = 1e-6;
constexpr double more = 30;
constexpr int tries_of_slip = 8;
// Sliding that ends within this part of the sub-step is stopped at once. The slip lost in this part
// gives the first estimate of when the other contacts stop.
constexpr double shortest_slide = 1.0 / 256;
// Sliding that remains for less than this part of the sub-step is left to the next one.
constexpr double settled = 1e-4;
// With more events of a body than this in the step the search is skipped: between two of its
// impacts it slides only for a moment, and the impacts matter more than the time at which sliding
// stops.
constexpr int rattling_events = 3;
// A slip has stopped at this part of its initial value: round-off.
constexpr double stopped = 1e-9;

bool slides_faster(const Persistent& p, double slow)
{
    return p.slip_before.norm() > slow && p.impulse.squaredNorm() > 0;
}

// The time at which the first contact stops sliding, extrapolated linearly from the sub-step `h`.
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

// Plans the whole sub-step with friction opposing the slip at its end: sliding stops by an impulse.
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
                break; // the time before the stop is too short for a sub-step
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
