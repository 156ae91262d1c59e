// SPDX-License-Identifier: MIT
#include "hyoryu/fluid/pair_loops.hpp"

#include "loop_table.hpp"

namespace hyoryu {

const FluidLoops& fluid_loops(InstructionSet set)
{
    return *table_of(
        set, []<int bytes>(RegisterSizes<bytes>) { return fluid_loops<bytes>(); }, CompiledSets{});
}

} // namespace hyoryu
