// SPDX-License-Identifier: MIT
#include "hyoryu/sim/dealing.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

std::size_t at(Index k)
{
    return static_cast<std::size_t>(k);
}

} // namespace

void deal_plan(Comm& comm, const Scene& scene, const Filling& filling, Plan& plan)
{
    std::vector<Parcel> out(at(comm.size()));
    if (comm.rank() == 0) {
        const PlanFacts facts = facts_of(scene, filling);
        Parcel parcel;
        put(parcel, facts.fluid);
        put(parcel, facts.wall);
        put(parcel, facts.particle_volume);
        put(parcel, facts.expected_speed);
        put_list(parcel, facts.body_points);
        put_list(parcel, facts.surface_points);
        std::ranges::fill(out, parcel);
    }
    const std::vector<Parcel> in = comm.exchange(std::move(out));
    if (comm.rank() > 0) {
        Unpacking from(in.front());
        PlanFacts facts;
        facts.fluid = from.take<Index>();
        facts.wall = from.take<Index>();
        facts.particle_volume = from.take<double>();
        facts.expected_speed = from.take<double>();
        facts.body_points = take_list<Index>(from);
        facts.surface_points = take_list<Index>(from);
        plan = plan_of(scene, facts);
    }
}

} // namespace hyoryu
