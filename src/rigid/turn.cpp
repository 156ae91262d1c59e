// SPDX-License-Identifier: MIT
// Contacts of curves that turn within a sub-step. The contact of two rods that cross at a small
// angle runs along them much faster than they turn.
#include "sub_step.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// A normal between two curves may turn by this much in a sub-step: over more, where the contact
// will be is not foreseen and rods sink into each other [rad].
constexpr double most_turn = 0.01;
constexpr double short_of_turn = 0.8;
constexpr double most_shortening = 0.1;
constexpr int most_tries = 8;

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

} // namespace hyoryu
