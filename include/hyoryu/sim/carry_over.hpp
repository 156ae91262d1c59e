// SPDX-License-Identifier: MIT
// Transfer of the state of a run to a case with other output: other frames, rows and gauges.
#pragma once

#include "hyoryu/core/snapshot.hpp"
#include "hyoryu/scene/scene.hpp"

namespace hyoryu {

/// Changes the state, saved by `save` from a run of `before`, into one that `restore` takes for
/// `now`, a case with the same geometry and physics. Frames and rows that have another spacing in
/// time are next due at the first multiple of it after the state. Gauges that are in both cases
/// keep their state, others begin now. Throws IoError if the state does not fit `before`.
void carry_over(Snapshot& state, const Scene& before, const Scene& now);

} // namespace hyoryu
