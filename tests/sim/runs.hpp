// SPDX-License-Identifier: MIT
// Simulations of cases that are given as text, and what tests do with them.
#pragma once

#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/sim/checkpoint.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hyoryu {

/// The case at time 0; `overrides` are those of `hyoryu run --set`.
inline Simulation make(const std::string& text, const std::vector<std::string>& overrides = {})
{
    const Scene scene = parse_case(text, "test.toml", overrides);
    const Filling filling = fill(scene);
    return make_simulation(scene, make_plan(scene, filling), filling);
}

/// The same before the first lists, to be restored.
inline Simulation make_blank(const std::string& text,
                             const std::vector<std::string>& overrides = {})
{
    const Scene scene = parse_case(text, "test.toml", overrides);
    const Filling filling = fill(scene);
    return make_to_restore(scene, make_plan(scene, filling), filling);
}

/// One step; frames are taken note of as a run does.
inline void step_on(Simulation& sim)
{
    step(sim);
    sim.clock.frame += frame_due(sim.clock, sim.scene) ? 1 : 0;
}

inline void advance(Simulation& sim, int steps)
{
    for (int k = 0; k < steps; ++k) {
        step_on(sim);
    }
}

inline void expect_same_bits(const Snapshot& a, const Snapshot& b)
{
    ASSERT_EQ(a.arrays.size(), b.arrays.size());
    for (const auto& [name, column] : a.arrays) {
        EXPECT_EQ(column.values, b.arrays.at(name).values) << name;
    }
}

} // namespace hyoryu
