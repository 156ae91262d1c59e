// SPDX-License-Identifier: MIT
#include "sub_step.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

std::span<const Remembered> of_pair(std::span<const Remembered> known, const Feature& f)
{
    const auto of = [](const Remembered& r) { return std::pair(r.feature.a, r.feature.b); };
    const auto found = std::ranges::equal_range(known, std::pair(f.a, f.b), {}, of);
    return {found.begin(), found.end()};
}

// Index of the nearest force of the pair that is not yet assigned and pushes the bodies apart; -1
// if there is none.
std::ptrdiff_t nearest_untaken(const ContactMemory& memory, const Persistent& p,
                               std::span<const Remembered> forces)
{
    std::ptrdiff_t best = -1;
    double least = infinity;
    for (const Remembered& r : forces) {
        const std::ptrdiff_t k = &r - memory.known.data();
        const double distance = (r.place - p.place).squaredNorm();
        if (memory.taken[k] == 0 && distance < least && r.force.dot(p.candidate.touch.normal) > 0) {
            least = distance;
            best = k;
        }
    }
    return best;
}

} // namespace

void recall_forces(ContactMemory& memory, double h)
{
    memory.taken.assign(memory.known.size(), 0);
    const auto take = [&](Persistent& p, std::ptrdiff_t k) {
        p.impulse = h * memory.known[k].force;
        memory.taken[k] = 1;
        p.recalled = true;
    };
    const Feature* last = nullptr;
    std::span<const Remembered> forces; // of the pair of `last`
    const auto find_forces = [&](const Feature& f) {
        if (last == nullptr || last->a != f.a || last->b != f.b) {
            forces = of_pair(memory.known, f);
        }
        last = &f;
    };
    for (Persistent& p : memory.persistent) {
        const Feature& f = p.candidate.feature;
        p.place = in_frame(memory.poses[f.a], p.candidate.touch.point);
        find_forces(f);
        const auto known = std::ranges::find(forces, f, &Remembered::feature);
        if (known != forces.end()) {
            take(p, &*known - memory.known.data());
            p.friction_offset = memory.poses[f.a].R * known->friction_offset;
            p.stuck = known->stuck;
        }
    }
    for (Persistent& p : memory.persistent) {
        if (!p.recalled) {
            find_forces(p.candidate.feature);
            if (const std::ptrdiff_t k = nearest_untaken(memory, p, forces); k >= 0) {
                take(p, k);
            }
        }
    }
}

// Impulses that did not resolve their contacts are not reused: as repeated first guesses they would
// grow without bound.
void remember(ContactMemory& memory, double h)
{
    memory.recent.clear();
    for (const Persistent& p : memory.persistent) {
        const Vec3 friction_offset =
            memory.middle[p.candidate.feature.a].R.transpose() * p.touches.push_friction_offset;
        const Vec3 force = p.unsolved ? Vec3(Vec3::Zero()) : Vec3(p.impulse / h);
        memory.recent.push_back({p.candidate.feature, force, p.place, friction_offset, p.stuck});
    }
    sort_by_feature(memory.recent);
    memory.known = memory.recent;
}

} // namespace hyoryu
