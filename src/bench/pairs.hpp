// SPDX-License-Identifier: MIT
// Pairs that count.
#pragma once

#include "hyoryu/fluid/fluid.hpp"

namespace hyoryu::bench {

/// Directed pairs of different particles within the support, among those of a list.
double pairs_within_support(const Fluid& fluid, const PairList& list);

} // namespace hyoryu::bench
