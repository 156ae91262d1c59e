// SPDX-License-Identifier: MIT
// The number of interacting pairs in a neighbour list.
#pragma once

#include "hyoryu/fluid/fluid.hpp"

namespace hyoryu::bench {

/// Directed pairs of different particles within the support, among those of a list of a process
/// that has the whole case.
double pairs_within_support(const Fluid& fluid, const PairList& list);

} // namespace hyoryu::bench
