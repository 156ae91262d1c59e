// SPDX-License-Identifier: MIT
// A cluster in parts that do not meet within the step.
#pragma once

#include "sub_step.hpp"

#include <functional>

namespace hyoryu {

/// Advances the bodies of a cluster by the whole step with all its pairs.
using AdvanceCluster = std::function<void(const StepContext&, const Cluster&)>;

/// Splits the cluster into groups whose bodies, as they move now, do not come near those of another
/// group, and advances each on its own: an impact costs its group alone, and is seen by no other.
/// What impacts made of the motion is looked at afterwards. Groups that might have met are put
/// back and advanced again as one, so that no contact is missed (Mirtich 2000, timewarp).
void advance_in_groups(const StepContext& context, const Cluster& cluster,
                       const AdvanceCluster& advance);

/// How far a body came off its free path over a sub-step of which it went `s`.
void note_motion(const StepContext& context, const SubStep& sub, double s);

} // namespace hyoryu
