// SPDX-License-Identifier: MIT
// Which force of the last sub-step a contact starts from.
#include "rigid/motion/sub_step.hpp"

#include <gtest/gtest.h>

namespace hyoryu::test_warm_start {
namespace {

// Corner i of body 1 on face f of body 0, at a place on the top of body 0.
Feature corner_on_face(int i, int f)
{
    return {0, 1, FeatureKind::corner_face, 1, i, 0, 0, 0, f};
}

Persistent contact(const Feature& feature, const Vec3& place)
{
    Persistent p;
    p.candidate.feature = feature;
    p.candidate.touch.point = place;
    p.candidate.touch.normal = {0, 0, -1};
    return p;
}

class WarmStart : public testing::Test {
protected:
    void SetUp() override
    {
        memory.poses = {pose_of({0, 0, 0}, Quat::Identity()), pose_of({0, 0, 1}, Quat::Identity())};
        // Sorted by feature, as they are kept.
        forces = {{corner_on_face(0, 5), {0, 0, -4}, {-0.5, 0, 0.5}},
                  {corner_on_face(1, 5), {0, 0, -6}, {0.5, 0, 0.5}}};
        memory.known = forces;
    }

    ContactMemory memory;
    std::vector<Remembered> forces;
};

TEST_F(WarmStart, TheSameFeatureComesBackAsImpulse)
{
    memory.persistent = {contact(corner_on_face(1, 5), {-0.5, 0, 0.5})};
    recall_forces(memory, 0.5);
    EXPECT_EQ(memory.persistent[0].impulse, Vec3(0, 0, -3)) << "though the other force is nearer";
}

TEST_F(WarmStart, AnotherFeatureTakesTheNearestForceOfItsPairOnce)
{
    memory.persistent = {contact(corner_on_face(2, 5), {0.4, 0, 0.5}),
                         contact(corner_on_face(3, 5), {0.5, 0, 0.5}),
                         contact(corner_on_face(4, 5), {0.5, 0, 0.5})};
    recall_forces(memory, 1);
    EXPECT_EQ(memory.persistent[0].impulse, Vec3(0, 0, -6));
    EXPECT_EQ(memory.persistent[1].impulse, Vec3(0, 0, -4));
    EXPECT_EQ(memory.persistent[2].impulse, Vec3(0, 0, 0));
}

TEST_F(WarmStart, OtherPairsAndForcesThatPullAreNotTaken)
{
    Feature of_others = corner_on_face(0, 5);
    Feature of_wall = of_others; // sorted before all that is known, the other behind it
    of_others.b = 2;
    of_wall.b = -1;
    Persistent from_below = contact(corner_on_face(2, 5), {0.5, 0, 0.5});
    from_below.candidate.touch.normal = {0, 0, 1};
    memory.persistent = {contact(of_wall, {0.5, 0, 0.5}), contact(of_others, {0.5, 0, 0.5}),
                         from_below};
    recall_forces(memory, 1);
    for (const Persistent& p : memory.persistent) {
        EXPECT_EQ(p.impulse, Vec3(0, 0, 0));
    }
}

TEST_F(WarmStart, PlacesMoveWithTheBody)
{
    memory.poses[0] =
        pose_of({0, -3, 0}, Quat(std::sqrt(0.5), 0, 0, std::sqrt(0.5))); // a quarter turn about z
    memory.persistent = {
        contact(corner_on_face(2, 5), {-3.5, 0, 0.5})}; // (0.5, 0, 0.5) in its axes
    recall_forces(memory, 1);
    EXPECT_EQ(memory.persistent[0].impulse, Vec3(0, 0, -6));
}

} // namespace
} // namespace hyoryu::test_warm_start
