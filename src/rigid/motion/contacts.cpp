// SPDX-License-Identifier: MIT
// Contact search of a cluster, and the solution of its contact problem island by island.
#include "sub_step.hpp"
#include "union_find.hpp"

#include "hyoryu/core/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace hyoryu {

namespace {

// Contacts below which waking the other threads costs more than they save.
constexpr std::size_t worth_sharing_contacts = 64;
// Cost limits for locating impacts [updates of rows]. Per cluster: sixteen times a step of a stack
// of ten, enough for the passes of a box that slides on its faces between many impacts. Per body: a
// value at which locating adds at most a fifth to the cost of a heap with many impacts.
constexpr double work_of_cluster = 8000;
constexpr double work_of_body = 100;

// Joins the movable bodies that share a row; the smallest index is the root.
void join_bodies(const std::vector<Row>& rows, ContactMemory& memory)
{
    memory.parents.resize(memory.rotors.size());
    for (const Row& row : rows) {
        memory.parents[row.a] = row.a;
        memory.parents[std::max(row.b, 0)] = std::max(row.b, 0);
    }
    for (const Row& row : rows) {
        if (row.b >= 0 && memory.rotors[row.a].movable && memory.rotors[row.b].movable) {
            const int a = root_of(memory.parents, row.a);
            const int b = root_of(memory.parents, row.b);
            memory.parents[std::max(a, b)] = std::min(a, b);
        }
    }
}

// Sorts the rows into islands, which share no movable body, in the order of their first rows.
// Returns the end of each island.
std::vector<std::size_t> sort_into_islands(std::vector<Row>& rows, ContactMemory& memory)
{
    join_bodies(rows, memory);
    memory.island_of_root.assign(memory.rotors.size(), -1);
    memory.island_of_row.clear();
    std::vector<std::size_t> ends;
    for (const Row& row : rows) {
        const int body = memory.rotors[row.a].movable ? row.a : row.b;
        int& island = memory.island_of_root[root_of(memory.parents, body)];
        if (island < 0) {
            island = static_cast<int>(ends.size());
            ends.push_back(0);
        }
        memory.island_of_row.push_back(island);
        ++ends[island];
    }
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    if (ends.size() > 1) {
        memory.group.resize(rows.size());
        for (std::size_t k = rows.size(); k-- > 0;) { // ends become begins
            memory.group[--ends[memory.island_of_row[k]]] = rows[k];
        }
        rows.swap(memory.group);
        std::rotate(ends.begin(), ends.begin() + 1, ends.end());
        ends.back() = rows.size();
    }
    return ends;
}

} // namespace

bool exceeds_event_limit(const ContactMemory& memory, int a, int b)
{
    return memory.events[a] > memory.event_limit ||
           (b >= 0 && memory.events[b] > memory.event_limit);
}

double located_work(const StepContext& context, const Cluster& cluster)
{
    const auto bodies = static_cast<double>(cluster.bodies.size());
    const double part = bodies / static_cast<double>(context.rigid.bodies.size());
    return work_of_cluster + work_of_body * bodies + part * context.rigid.settings.located_work;
}

void lower_event_limit(ContactMemory& memory, const Cluster& cluster)
{
    int most = 0;
    for (const int k : cluster.bodies) {
        most = std::max(most, memory.events[k]);
    }
    if (memory.work > 0.5 * memory.worth) {
        memory.event_limit = std::min(memory.event_limit, most / 2);
    }
    memory.stepped = memory.stepped || most > memory.event_limit;
}

void find_contacts(const StepContext& context, const Cluster& cluster, double time)
{
    ContactMemory& memory = context.memory;
    memory.candidates.clear();
    const Configuration now = configuration(memory, memory.poses, time);
    memory.work += look_work * static_cast<double>(cluster.pairs.size());
    for (const BodyPair& pair : cluster.pairs) {
        const std::span<const Candidate> found = look_at(memory, pair, now);
        memory.candidates.insert(memory.candidates.end(), found.begin(), found.end());
    }
    double& worst = context.rigid.counters.worst_penetration;
    for (const Candidate& candidate : memory.candidates) {
        worst = std::max(worst, -candidate.touch.gap);
    }
}

double solve_islands(std::vector<Row>& rows, ContactMemory& memory, const Effort& effort)
{
    memory.island_ends = sort_into_islands(rows, memory);
    const std::vector<std::size_t>& ends = memory.island_ends;
    memory.solvers.resize(std::max(memory.solvers.size(), ends.size()));
    memory.left.assign(ends.size(), 0);
    const auto rows_of = [&](std::size_t island) {
        const std::size_t begin = island == 0 ? 0 : ends[island - 1];
        return std::span(rows).subspan(begin, ends[island] - begin);
    };
    const auto solve_one = [&](std::size_t island) {
        memory.solvers[island].updates = 0;
        memory.solvers[island].unit = std::sqrt(memory.geometry.unit);
        memory.left[island] =
            solve(rows_of(island), memory.responses, memory.solvers[island], effort);
    };
    // Islands whose sweeps use all threads are solved one after another, the others in parallel.
    const auto is_shared = [&](std::size_t island) {
        return rows_of(island).size() >= worth_colouring;
    };
    for (std::size_t island = 0; island < ends.size(); ++island) {
        if (is_shared(island)) {
            solve_one(island);
        }
    }
    const auto solve_small = [&](Index k) {
        if (!is_shared(static_cast<std::size_t>(k))) {
            solve_one(static_cast<std::size_t>(k));
        }
    };
    const Index worth =
        rows.size() < worth_sharing_contacts ? std::numeric_limits<Index>::max() : 2;
    parallel_blocks(0, static_cast<Index>(ends.size()), solve_small, worth);
    memory.work += plan_work * static_cast<double>(rows.size());
    for (std::size_t island = 0; island < ends.size(); ++island) {
        memory.work += memory.solvers[island].updates;
    }
    return ends.empty() ? 0 : *std::max_element(memory.left.begin(), memory.left.end());
}

} // namespace hyoryu
