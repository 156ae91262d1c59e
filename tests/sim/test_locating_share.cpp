// SPDX-License-Identifier: MIT
// What locating impacts may cost beside the fluid: the key `contact.locating_share`.
#include "runs.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

namespace hyoryu::test_locating_share {
namespace {

// A row of boxes that slide into a pile beside a puddle.
constexpr const char* pile = R"(
[time]
end = 0.2
step = 1e-3
[particles]
spacing = 0.05
[fluid]
[[fluid.block]]
shape = "box"
min = [3.0, 0.0, 0.0]
max = [3.6, 0.6, 0.3]
[[wall]]
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [3.6, 0.6, 1.0]
open = ["+z"]
[[body]]
shape = "box"
size = [0.15, 0.15, 0.15]
density = 500
position = [0.2, 0.12, 0.1]
velocity = [1.5, 0.3, 0]
copies.count = [3, 1, 3]
copies.pitch = [0.17, 0.2, 0.17]
)";

struct Outcome {
    double settings = 0;
    long long unlocated_steps = 0;
};

Outcome run_with(double share)
{
    Simulation sim = make(pile, {fmt::format("contact.locating_share={}", share)});
    const double located_work = sim.rigid.settings.located_work;
    while (!finished(sim.clock, sim.scene)) {
        step_on(sim);
    }
    return {located_work, sim.rigid.counters.capped_steps};
}

TEST(LocatingShare, BuysTheLocationOfImpacts)
{
    const Outcome none = run_with(0);
    const Outcome usual = run_with(0.2);
    const Outcome large = run_with(2);
    EXPECT_EQ(none.settings, 0);
    EXPECT_DOUBLE_EQ(10 * usual.settings, large.settings);
    EXPECT_GT(none.unlocated_steps, large.unlocated_steps);
}

} // namespace
} // namespace hyoryu::test_locating_share
