// SPDX-License-Identifier: MIT
// The state to named datasets and back: all data that a restart with the same bits needs.
#pragma once

#include "hyoryu/core/snapshot.hpp"
#include "hyoryu/sim/simulation.hpp"

namespace hyoryu {

/// The whole mutable state between two steps, and what was done so far. Called by all ranks.
Snapshot save(const Simulation& sim);

/// The same, made array by array when it is asked for, from a simulation that lives as long and
/// does not change. Called by all ranks; each asks for what it needs.
StateOnDemand state_of(const Simulation& sim);

/// Puts the state into a simulation that was made from the same case. Throws IoError if the
/// snapshot does not fit it.
void restore(Simulation& sim, const Snapshot& snapshot);

/// The time of a snapshot [s]. Throws IoError if it has none.
double time_of(const Snapshot& snapshot);

} // namespace hyoryu
