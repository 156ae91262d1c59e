// SPDX-License-Identifier: MIT
// The stages of a step in which an effect may be summed over pairs, and passes: separate loops over
// pairs for a single effect.
//
// An effect whose pair term belongs to a stage names it, `using Stage = stage::Forces`, and is
// summed in one loop with the terms that are always there. An effect that needs a sum before that
// declares a pass of its own in its file, `using Passes = PassList<...>`, and runs it from there.
#pragma once

#include "hyoryu/core/sweep.hpp"

namespace hyoryu {

namespace stage {
struct Forces {};   // fluid <- fluid, with the pressure: reads positions, volumes and pressures
struct Rates {};    // fluid <- fluid, with continuity: reads velocities too
struct Crowding {}; // fluid <- fluid and solid, after the rates
} // namespace stage

/// A list of passes. A pass is a type with
///     static void call(const FluidTerms& terms, const auto& f)
/// that calls f with the terms to be summed together.
template <class... P>
struct PassList {
    static constexpr int count = sizeof...(P);
};

/// Place of a pass in a list; the length of the list if it is not there.
template <class P, class List>
inline constexpr int pass_index = 0;
template <class P, class... Q>
inline constexpr int pass_index<P, PassList<Q...>> = [] {
    int at = 0;
    int found = sizeof...(Q);
    ((found = std::is_same_v<P, Q> ? at : found, ++at), ...);
    return found;
}();

template <class... List>
struct JoinedPasses;
template <class... P>
struct JoinedPasses<PassList<P...>> {
    using type = PassList<P...>;
};
template <class... P, class... Q, class... Rest>
struct JoinedPasses<PassList<P...>, PassList<Q...>, Rest...>
    : JoinedPasses<PassList<P..., Q...>, Rest...> {
};

/// The pass of one term without parameters.
template <class Term>
struct PassOf {
    static void call(const auto&, const auto& f) { f(Term{}); }
};

} // namespace hyoryu
