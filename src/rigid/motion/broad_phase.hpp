// SPDX-License-Identifier: MIT
// Which bodies and boundaries may meet within a step.
#pragma once

#include "memory.hpp"

namespace hyoryu {

/// Splits the bodies into clusters that cannot meet within the step, by sweeping boxes that bound
/// their motion. The speed of a body is bounded by twice the largest speed of its cluster, which is
/// the speed after an impact by a much heavier body. A body in free flight is a cluster without
/// pairs.
void find_clusters(const StepContext& context);

} // namespace hyoryu
