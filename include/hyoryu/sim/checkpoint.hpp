// SPDX-License-Identifier: MIT
// The state to named arrays and back: all data that a restart with the same bits needs.
#pragma once

#include "hyoryu/core/snapshot.hpp"
#include "hyoryu/sim/simulation.hpp"

namespace hyoryu {

// Names of arrays that a run with other output changes (see carry_over.hpp).
inline constexpr const char* clock_array = "clock";
inline constexpr const char* frame_offset_array = "frame_offset";
inline constexpr const char* gauges_array = "gauges";

/// The whole mutable state between two steps.
Snapshot save(const Simulation& sim);

/// Puts the state into a simulation that was made from the same case. Throws IoError if the
/// snapshot does not fit it.
void restore(Simulation& sim, const Snapshot& snapshot);

} // namespace hyoryu
