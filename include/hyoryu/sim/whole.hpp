// SPDX-License-Identifier: MIT
// Output of a simulation that several processes share.
#pragma once

#include "hyoryu/sim/simulation.hpp"

#include <functional>

namespace hyoryu {

/// Calls `look` on rank 0, while the simulation has the particles of all ranks there and looks like
/// that of one process; what it changes of the particles is lost. Called by all ranks. Needs memory
/// for all particles on rank 0. `comm`: null for one process, which calls `look` at once.
void with_whole(Simulation& sim, Comm* comm, const std::function<void()>& look);

} // namespace hyoryu
