// SPDX-License-Identifier: MIT
// Moreau's law: all touching contacts of an island at once (Moreau 1988).
#include "impact_law.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// Removes the rows of islands in which no contact approaches faster than the resting speed.
void keep_struck(const StepContext& context, const Round& round, std::vector<Row>& rows)
{
    const ContactMemory& memory = context.memory;
    std::vector<bool> struck(context.rigid.bodies.size(), false);
    const auto movable = [&](int k) { return k >= 0 && memory.rotors[k].movable; };
    const auto is_struck = [&](const Row& row) {
        return row.before[0] < -round.slow || (movable(row.a) && struck[row.a]) ||
               (movable(row.b) && struck[row.b]);
    };
    for (bool spreads = true; spreads;) {
        spreads = false;
        for (const Row& row : rows) {
            if (!is_struck(row)) {
                continue;
            }
            for (const int k : {row.a, row.b}) {
                spreads = spreads || (movable(k) && !struck[k]);
                if (movable(k)) {
                    struck[k] = true;
                }
            }
        }
    }
    std::erase_if(rows, [&](const Row& row) { return !is_struck(row); });
}

} // namespace

double simultaneous_round(const StepContext& context, Round& round)
{
    ContactMemory& memory = context.memory;
    collect(context, round, infinity, memory.rows);
    keep_struck(context, round, memory.rows);
    round.closing = memory.rows.empty() || round.least == infinity;
    if (memory.rows.empty()) {
        return 0;
    }
    const double left = solve_islands(memory.rows, memory, round.effort);
    clamp_energy(memory.rows, memory, round.effort);
    std::erase_if(memory.rows, [](const Row& row) { return row.p.isZero(0); });
    return left;
}

} // namespace hyoryu
