// SPDX-License-Identifier: MIT
// Load balancing of rigid bodies over ranks. All ranks hold all bodies; groups that do not meet
// within a step may be advanced by any rank. Each rank advances groups of about equal total cost,
// as measured in the last step, and sends their outcome to the others. The result is that of one
// process bit for bit, independent of the distribution.
#pragma once

#include "outcome.hpp"

namespace hyoryu {

/// Advances all clusters of a step on several ranks, in groups that do not meet. The groups are
/// distributed if this saves more than the message costs.
void advance_dealt_out(const StepContext& context, const AdvanceCluster& advance, Comm& comm);

} // namespace hyoryu
