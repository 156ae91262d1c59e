// SPDX-License-Identifier: MIT
// What a particle costs in memory, counted as capacity.
#include "bench/dam_break.hpp"

#include <gtest/gtest.h>

namespace hyoryu::bench {
namespace {

TEST(Memory, OfADamBreakInSpaceWithAllOn)
{
    // 57,000 fluid particles at h/dp = 1.5 in flow: large enough that pages of lists, a megabyte
    // each, are filled.
    constexpr double most = 450; // [B] a particle
    Simulation sim = make_dam_break(0.0112);
    develop(sim, 0.1, {});
    ASSERT_GT(sim.fluid->neighbours.builds, 2);
    const auto bytes = static_cast<double>(total(memory_of(*sim.fluid)));
    const auto particles = static_cast<double>(sim.fluid->particles.size());
    EXPECT_LT(bytes / particles, most);
    // The parts that cannot be missing: columns of 152 bytes and records of 32.
    EXPECT_GT(bytes / particles, 152 + 32);
}

} // namespace
} // namespace hyoryu::bench
