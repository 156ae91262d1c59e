// SPDX-License-Identifier: MIT
#include "hot_loops.hpp"

namespace hyoryu::bench {

const HotLoopTable& hot_loops_for(InstructionSet set)
{
    return *table_of(
        set, []<int bytes>(RegisterSizes<bytes>) { return hot_loops<bytes>(); }, CompiledSets{});
}

} // namespace hyoryu::bench
