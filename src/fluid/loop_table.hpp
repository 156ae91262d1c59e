// SPDX-License-Identifier: MIT
// The pair loops as compiled for one instruction set.
#pragma once

#include "hyoryu/core/compiled_sets.hpp"
#include "hyoryu/fluid/pair_loops.hpp"

namespace hyoryu {

template <int bytes>
const FluidLoops* fluid_loops();

} // namespace hyoryu
