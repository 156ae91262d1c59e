// SPDX-License-Identifier: MIT
// The datasets of a state that tell what was done so far, for the summary of a run. They are absent
// in checkpoints of earlier versions: what they count is then counted from there on.
#pragma once

#include "hyoryu/core/state.hpp"
#include "hyoryu/ranks/comm.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <cmath>

namespace hyoryu {

inline const std::string visits_so_far = "work/pair_interactions";
inline const std::string steps_so_far = "work/steps_by_limit/"; // and the name of the limit

/// List entries evaluated so far by all processes, which call this together.
inline double count_visits(const Simulation& sim)
{
    std::int64_t visits = std::llround(sim.pair_visits);
    if (sim.comm != nullptr) {
        sim.comm->add({&visits, 1});
    }
    return sim.earlier_visits + static_cast<double>(visits);
}

template <class State>
void write_work(State& state, const Simulation& sim, double visits)
{
    state(visits_so_far, "", visits);
    for (const auto& [limit, steps] : sim.steps_by_limit) {
        state(steps_so_far + limit, "", steps);
    }
}

inline void read_work(const Snapshot& snapshot, Simulation& sim)
{
    StateReader state(snapshot);
    sim.pair_visits = sim.earlier_visits = 0;
    sim.steps_by_limit.clear();
    for (const auto& [name, column] : snapshot.arrays) {
        if (name == visits_so_far) {
            state(name, "", sim.earlier_visits);
        } else if (name.starts_with(steps_so_far)) {
            state(name, "", sim.steps_by_limit[name.substr(steps_so_far.size())]);
        }
    }
}

} // namespace hyoryu
