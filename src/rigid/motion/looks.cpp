// SPDX-License-Identifier: MIT
// A cache of collision queries: the contacts of a pair are reused while its bodies have not moved.
// The end of a sub-step is queried by the event search, by the impacts there and by the next
// sub-step.
#include "memory.hpp"

#include "hyoryu/core/error.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

bool same_place(const SolidPose& a, const SolidPose& b)
{
    return a.x == b.x && a.q.coeffs() == b.q.coeffs();
}

// The pose of the partner of a pair; of a wall the displacement, as it does not turn.
SolidPose pose_of_partner(int b, const Configuration& at)
{
    if (b >= 0) {
        return at.poses[b];
    }
    return {displacement(at.geometry.walls[-1 - b].motion, at.time)};
}

} // namespace

void keep_cache(ContactMemory& memory)
{
    std::vector<CachedContacts>& looks = memory.looks;
    std::vector<CachedContacts> kept;
    for (const Cluster& cluster : memory.clusters) {
        for (const BodyPair& pair : cluster.pairs) {
            kept.push_back({pair});
        }
    }
    std::ranges::sort(kept, {}, &CachedContacts::pair);
    auto last = looks.begin();
    for (CachedContacts& look : kept) {
        last = std::ranges::lower_bound(last, looks.end(), look.pair, {}, &CachedContacts::pair);
        if (last != looks.end() && last->pair == look.pair) {
            look = std::move(*last);
        }
    }
    looks.swap(kept);
}

std::span<const Candidate> look_at(ContactMemory& memory, const BodyPair& pair,
                                   const Configuration& at)
{
    const auto found = std::ranges::lower_bound(memory.looks, pair, {}, &CachedContacts::pair);
    expects(found != memory.looks.end() && found->pair == pair);
    CachedContacts& look = *found;
    const SolidPose& a = at.poses[pair.a];
    const SolidPose b = pose_of_partner(pair.b, at);
    if (!look.known || !same_place(look.a, a) || !same_place(look.b, b)) {
        look.known = true;
        look.a = a;
        look.b = b;
        look.found.clear();
        find_candidates(pair, at, clearly_apart(at.geometry), look.found);
    }
    return look.found;
}

} // namespace hyoryu
