// SPDX-License-Identifier: MIT
// The end of sliding within a sub-step. Friction jumps there, and a step across it would be of
// first order: the sub-step ends where the first contact stops sliding. It ends sooner where a
// contact of rods turns fast.
#include "sub_step.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// Sliding slower than this has no direction that is worth following [m/s].
constexpr double no_slip = 1e-4;
// The sub-step ends this part before the slip does, so that the direction of sliding holds in it;
// more if that turns out to be too near.
constexpr double short_of = 1e-6;
constexpr double more = 30;
constexpr int most_tries = 8;
// In piles other errors are larger, and some contact stops in every step.
constexpr std::size_t most_contacts = 16;
// A rest of sliding of this part of the sub-step is left to the next one.
constexpr double settled = 1e-4;
// A normal between two curves may turn by this much in a sub-step: over more, where the contact
// will be is not foreseen and rods sink into each other [rad].
constexpr double most_turn = 0.01;
constexpr double short_of_turn = 0.8;
constexpr double most_shortening = 0.1;
// Round-off of a slip that has stopped, as a part of what it was.
constexpr double stopped = 1e-9;

bool slides(const Persistent& p)
{
    return p.slip_before.norm() > no_slip && p.impulse.squaredNorm() > 0;
}

// The time at which the first contact stops sliding, if its speed goes on as it does in `h`.
double extrapolated(const std::vector<Persistent>& contacts, double h)
{
    double first = infinity;
    for (const Persistent& p : contacts) {
        const double before = p.slip_before.squaredNorm();
        const double lost = before - p.slip_before.dot(p.slip_after);
        if (slides(p) && lost > 0) {
            first = std::min(first, h * before / lost);
        }
    }
    return first;
}

bool stops(const std::vector<Persistent>& contacts)
{
    return std::any_of(contacts.begin(), contacts.end(), [](const Persistent& p) {
        return slides(p) &&
               p.slip_before.dot(p.slip_after) <= stopped * p.slip_before.squaredNorm();
    });
}

// From the velocities at the start of the sub-step.
void plan_again(const StepContext& context, const SubStep& sub)
{
    set_responses(context, sub.cluster);
    plan_motion(context, sub);
}

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

// The contact of two rods that cross at a small angle runs along them much faster than they turn.
void end_with_turn(const StepContext& context, SubStep& sub)
{
    for (int k = 0; k < most_tries; ++k) {
        const double turn = largest_turn(context.memory.persistent);
        if (turn <= most_turn) {
            return;
        }
        sub.h *= std::max(most_shortening, short_of_turn * most_turn / turn);
        plan_again(context, sub);
    }
}

} // namespace

void end_with_slip(const StepContext& context, SubStep& sub)
{
    end_with_turn(context, sub);
    std::vector<Persistent>& contacts = context.memory.persistent;
    if (contacts.size() > most_contacts || !stops(contacts)) {
        return;
    }
    const double whole = sub.h;
    double end = 0.5 * whole;
    double margin = short_of;
    bool known = false; // whether `end` is extrapolated
    for (int k = 0; k < most_tries; ++k) {
        sub.h = known ? (1 - margin) * end : end;
        plan_again(context, sub);
        if (stops(contacts)) {
            end = known ? end : 0.5 * end;
            margin *= known ? more : 1;
            continue;
        }
        if (known && margin > short_of) {
            return; // it stops a little later
        }
        end = std::min(extrapolated(contacts, sub.h), whole);
        known = true;
        if (end - sub.h <= settled * whole) {
            return;
        }
    }
    sub.h = whole; // it stops at once, by an impulse: there is no time before it
    plan_again(context, sub);
}

} // namespace hyoryu
