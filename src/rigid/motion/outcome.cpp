// SPDX-License-Identifier: MIT
#include "outcome.hpp"

#include <algorithm>
#include <utility>

namespace hyoryu {

void advance_apart(const StepContext& context, Outcome& outcome, const AdvanceCluster& advance)
{
    ContactMemory& memory = context.memory;
    const RigidCounters counters = std::exchange(context.rigid.counters, {});
    const bool jammed = std::exchange(memory.jammed, false);
    const std::size_t known = memory.fresh.size();
    advance({context.rigid, memory, context.loads, outcome.log, context.start, context.dt},
            outcome.cluster);
    const auto first = memory.fresh.begin() + static_cast<std::ptrdiff_t>(known);
    outcome.fresh.assign(first, memory.fresh.end());
    memory.fresh.erase(first, memory.fresh.end());
    outcome.jammed = std::exchange(memory.jammed, jammed);
    outcome.counters = std::exchange(context.rigid.counters, counters);
    outcome.done = true;
}

void hand_over(const StepContext& context, const Outcome& outcome)
{
    ContactMemory& memory = context.memory;
    RigidCounters& sum = context.rigid.counters;
    sum.impacts += outcome.counters.impacts;
    sum.rounds += outcome.counters.rounds;
    sum.events += outcome.counters.events;
    sum.tangential_impacts += outcome.counters.tangential_impacts;
    sum.worst_residual = std::max(sum.worst_residual, outcome.counters.worst_residual);
    sum.worst_penetration = std::max(sum.worst_penetration, outcome.counters.worst_penetration);
    memory.jammed = memory.jammed || outcome.jammed;
    memory.fresh.insert(memory.fresh.end(), outcome.fresh.begin(), outcome.fresh.end());
    context.log.insert(context.log.end(), outcome.log.begin(), outcome.log.end());
}

} // namespace hyoryu
