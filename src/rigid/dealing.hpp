// SPDX-License-Identifier: MIT
// Work on bodies that several ranks share. All of them have all bodies; what does not meet within a
// step may be advanced by any of them. Each advances a part, of about equal cost as the last step
// told it, and sends the others what became of it: the order and the bits are those of one process,
// whoever did what.
#pragma once

#include "outcome.hpp"

namespace hyoryu {

/// Advances all clusters of a step by several ranks, in groups that do not meet. Ranks deal out the
/// groups where that saves more than the message costs.
void advance_dealt_out(const StepContext& context, const AdvanceCluster& advance, Comm& comm);

} // namespace hyoryu
