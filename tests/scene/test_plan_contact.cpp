// SPDX-License-Identifier: MIT
// What the plan says of contact: method, law, and what every pair of materials has.
#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace hyoryu::test_plan_contact {
namespace {

const std::string yard = R"(
[time]
end = 1.0
[particles]
spacing = 0.05
[[wall]]
shape = "plane"
material = "concrete"
[[body]]
shape = "box"
size = [0.2, 0.2, 0.2]
density = 500
position = [0, 0, 1]
material = "pine"
[[body]]
shape = "box"
size = [0.2, 0.2, 0.2]
density = 500
position = [1, 0, 1]
material = "pine"
[[body]]
shape = "sphere"
radius = 0.2
density = 500
position = [2, 0, 1]
fixed = true
material = "steel"
[contact]
restitution = 0.2
friction = 0.1
[[contact.pair]]
materials = ["concrete", "pine"]
restitution = 0.4
friction = 0.6
stiffness = 2.4e6
)";

Plan plan_of(const std::vector<std::string>& overrides)
{
    const Scene scene = parse_case(yard, "case.toml", overrides);
    return make_plan(scene, fill(scene));
}

bool is_off(const Plan& plan, const std::string& name)
{
    return std::any_of(plan.off.begin(), plan.off.end(),
                       [&](const Plan::Effect& effect) { return effect.name == name; });
}

TEST(PlanOfContact, NamesTheMethodAndTheLaw)
{
    const Plan usual = plan_of({});
    EXPECT_TRUE(usual.runs("contact_impulse") && usual.runs("law_coupled"));
    EXPECT_TRUE(is_off(usual, "contact_penalty") && is_off(usual, "law_paper"));
    const Plan paper = plan_of({"contact.law=paper"});
    EXPECT_TRUE(paper.runs("law_paper"));
    EXPECT_TRUE(is_off(paper, "law_coupled") && is_off(paper, "law_simultaneous"));
    const Plan penalty = plan_of({"contact.method=penalty"});
    EXPECT_TRUE(penalty.runs("contact_penalty"));
    EXPECT_TRUE(is_off(penalty, "contact_impulse") && is_off(penalty, "law_coupled"));
}

TEST(PlanOfContact, ResolvesEveryPairOfMaterialsThatCanMeet)
{
    const Plan plan = plan_of({});
    // The fixed steel sphere meets pine only, never the floor.
    ASSERT_EQ(plan.materials.size(), 3u);
    const auto& [floor, self, steel] =
        std::tie(plan.materials[0], plan.materials[1], plan.materials[2]);
    EXPECT_EQ(floor.materials, (std::array<std::string, 2>{"pine", "concrete"}));
    EXPECT_TRUE(floor.listed);
    EXPECT_EQ(floor.restitution, 0.4);
    EXPECT_EQ(floor.friction, 0.6);
    EXPECT_EQ(floor.stiffness, 2.4e6);
    EXPECT_EQ(self.materials, (std::array<std::string, 2>{"pine", "pine"}));
    EXPECT_EQ(steel.materials, (std::array<std::string, 2>{"pine", "steel"}));
    EXPECT_FALSE(steel.listed);
    EXPECT_EQ(steel.restitution, 0.2);
    EXPECT_EQ(steel.friction, 0.1);
    EXPECT_FALSE(steel.stiffness);
}

TEST(PlanOfContact, RefusesWhatTheBuildIsWithout)
{
    const Plan plan = plan_of({});
    constexpr std::array<std::string_view, 3> absent{"gauges", "body_load", "shifting"};
    EXPECT_NO_THROW(expect_built(plan, absent));
    constexpr std::array<std::string_view, 2> asked{"gauges", "rigid_motion"};
    try {
        expect_built(plan, asked);
        FAIL() << "moving bodies are on";
    } catch (const CaseError& error) {
        EXPECT_EQ(error.diagnostics().front().what, "rigid_motion is not part of this build");
    }
}

TEST(PlanOfContact, WarnsOfLongPenaltySubSteps)
{
    EXPECT_TRUE(plan_of({"contact.method=penalty"}).warnings.empty());
    const Plan coarse = plan_of({"contact.method=penalty", "contact.penalty.step=1e-2"});
    ASSERT_EQ(coarse.warnings.size(), 1u);
    EXPECT_EQ(coarse.warnings[0].key, "contact.penalty.step");
}

} // namespace
} // namespace hyoryu::test_plan_contact
