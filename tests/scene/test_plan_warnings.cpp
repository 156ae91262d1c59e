// SPDX-License-Identifier: MIT
// What the plan warns of, and what it has no reason to.
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hyoryu {
namespace {

// A plank of two spacings, and of less than a third of the density of water: on end it would tip.
const std::string plank = R"(
dimensions = 2
[time]
end = 1.0
[particles]
spacing = 0.05
[[wall]]
shape = "plane"
[[body]]
shape = "box"
size = [0.1, 1.0, 1.0]
density = 300
position = [0, 0, 1]
)";

bool warns(const std::string& text, const std::string& words)
{
    const Scene scene = parse_case(text, "case.toml");
    const Plan plan = make_plan(scene, fill(scene));
    return std::ranges::any_of(plan.warnings, [&](const Diagnostic& warning) {
        return warning.what.find(words) != std::string::npos;
    });
}

TEST(PlanWarnings, OfThinAndTippingBodiesAreForWaterOnly)
{
    const std::string water = "[fluid]\n[[fluid.block]]\nshape = \"box\"\nmin = [1, 0, 0]\n"
                              "max = [2, 0, 0.5]\n";
    for (const char* words : {"less than 3 spacings", "will not float upright"}) {
        EXPECT_TRUE(warns(plank + water, words)) << words;
        EXPECT_FALSE(warns(plank, words)) << words << " in a scene without water";
    }
}

} // namespace
} // namespace hyoryu
