// SPDX-License-Identifier: MIT
// Contacts that take energy and give none, however roughly their impulses were solved for.
#include "sub_step.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Work relative to what was exchanged that is round-off.
constexpr double round_off_of_work = 1e-14;

} // namespace

double passive_share(const WorkOfShare& work)
{
    const double exchanged = std::abs(work.linear) + work.square;
    if (work.linear + work.square <= round_off_of_work * exchanged) {
        return 1;
    }
    return std::clamp(-work.linear / work.square, 0.0, 1.0);
}

WorkOfShare work_of_contacts(const ContactMemory& memory, std::span<const Row> rows)
{
    WorkOfShare work;
    for (const Row& row : rows) {
        const Vec3 start = row.D.transpose() * memory.persistent[row.contact].before;
        work.linear += 0.5 * row.p.dot(start + row.before);
        work.square += 0.5 * row.p.dot(velocity(row, memory.responses) - row.before);
    }
    return work;
}

void make_passive(ContactMemory& memory)
{
    std::size_t begin = 0;
    for (const std::size_t end : memory.island_ends) {
        const std::span<Row> rows = std::span(memory.rows).subspan(begin, end - begin);
        begin = end;
        const double share = passive_share(work_of_contacts(memory, rows));
        if (share < 1) {
            std::vector<Vec3> p;
            for (const Row& row : rows) {
                p.emplace_back(share * row.p);
            }
            set_impulses(rows, p, memory.responses);
        }
    }
}

} // namespace hyoryu
