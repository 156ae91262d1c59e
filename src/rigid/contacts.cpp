// SPDX-License-Identifier: MIT
// Contact search of a cluster and its islands.
#include "sub_step.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace hyoryu {

bool tired(const ContactMemory& memory, int a, int b)
{
    return memory.events[a] > event_limit || (b >= 0 && memory.events[b] > event_limit);
}

void find_contacts(const StepContext& context, const Cluster& cluster, double time)
{
    ContactMemory& memory = context.memory;
    memory.candidates.clear();
    const Configuration now = configuration(memory, memory.poses, time);
    for (const Pair& pair : cluster.pairs) {
        find_candidates(pair, now, memory.candidates);
    }
    double& worst = context.rigid.counters.worst_penetration;
    for (const Candidate& candidate : memory.candidates) {
        if (!candidate.beyond) {
            worst = std::max(worst, -candidate.touch.gap);
        }
    }
}

double solve_islands(std::vector<Row>& rows, ContactMemory& memory)
{
    // Rows that share a movable body belong together; islands in the order of their first row.
    std::vector<int> island(rows.size());
    std::iota(island.begin(), island.end(), 0);
    std::map<int, int> island_of_body;
    const auto join = [&](int from, int to) {
        std::replace(island.begin(), island.end(), from, to);
        for (auto& [body, its] : island_of_body) {
            its = its == from ? to : its;
        }
    };
    for (std::size_t k = 0; k < rows.size(); ++k) {
        for (const int body : {rows[k].a, rows[k].b}) {
            if (body < 0 || !memory.rotors[body].movable) {
                continue;
            }
            const auto [known, added] = island_of_body.try_emplace(body, island[k]);
            if (!added && known->second != island[k]) {
                const int other = known->second;
                join(std::max(other, island[k]), std::min(other, island[k]));
            }
        }
    }
    if (std::all_of(island.begin(), island.end(), [](int k) { return k == 0; })) {
        return solve(rows, memory.responses, memory.solver);
    }
    double worst = 0;
    for (int k = 0; k < static_cast<int>(rows.size()); ++k) {
        memory.group.clear();
        for (std::size_t m = 0; m < rows.size(); ++m) {
            if (island[m] == k) {
                memory.group.push_back(rows[m]);
            }
        }
        if (memory.group.empty()) {
            continue;
        }
        worst = std::max(worst, solve(memory.group, memory.responses, memory.solver));
        std::size_t next = 0;
        for (std::size_t m = 0; m < rows.size(); ++m) {
            if (island[m] == k) {
                rows[m] = memory.group[next++];
            }
        }
    }
    return worst;
}

} // namespace hyoryu
