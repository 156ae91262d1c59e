// SPDX-License-Identifier: MIT
// What the plan warns of, and what it has no reason to.
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/plan.hpp"

#include <fmt/format.h>
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

// A paddle between upright sides, its foot at a height over the floor.
std::string paddle(double foot, const std::string& motion)
{
    return fmt::format("[time]\nend = 1.0\n[particles]\nspacing = 0.05\n[fluid]\n[[fluid.block]]\n"
                       "shape = \"box\"\nmin = [0.5, 0, 0]\nmax = [2, 0.4, 0.5]\n[[wall]]\n"
                       "name = \"flume\"\nshape = \"basin\"\nmin = [0, 0, 0]\n"
                       "max = [2, 0.4, 1]\nopen = [\"+z\"]\n[[wall]]\nname = \"paddle\"\n"
                       "shape = \"box\"\nmin = [0.3, 0.0, {}]\nmax = [0.5, 0.4, 1.0]\n{}",
                       foot, motion);
}

TEST(PlanWarnings, OfAGapThroughWhichAPaddleLeaks)
{
    const std::string moves = "motion.velocity = [0.1, 0, 0]\n";
    const std::string words = "\"paddle\" moves and leaves a gap";
    EXPECT_TRUE(warns(paddle(0.05, moves), words));
    EXPECT_TRUE(warns(paddle(0.1, moves), words));
    EXPECT_FALSE(warns(paddle(0.02, moves), words)) << "no particle fits in";
    EXPECT_FALSE(warns(paddle(0, moves), words));
    EXPECT_FALSE(warns(paddle(0.4, moves), words)) << "meant";
    EXPECT_FALSE(warns(paddle(0.05, ""), words)) << "it stands still";
}

} // namespace
} // namespace hyoryu
