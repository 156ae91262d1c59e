// SPDX-License-Identifier: MIT
// The ends of the chord of an edge that rocks over a cap.
#include "dice.hpp"
#include "scenes.hpp"

#include "rigid/collision/narrow_phase.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace hyoryu::test_rocking {
namespace {

using namespace test;

/// A cylinder on end on the ridge z = 0 of a fixed box, and the pose with its cap at an angle to
/// the ridge about a point of it.
struct OnRidge {
    Geometry geometry;
    std::vector<SolidPose> poses;
    Vec3 pivot{0, 0, 0};
    Vec3 centre{0, 0, 0};
    Quat stands = Quat::Identity();
    Vec3 axis{0, 1, 0}; // square to the ridge and upright

    explicit OnRidge(Dice& dice)
    {
        const double radius = dice.between(0.02, 0.1);
        const double length = dice.between(0.05, 0.3);
        geometry.solids = {solid_of(Rod{radius, length}, 3),
                           solid_of(box_polytope({1, 0.2, 0.2}, 3), 3)};
        const double half = 0.1 * std::sqrt(2.0);
        poses.resize(2);
        poses[1] = pose_of({0, 0, -half}, turn_about(Vec3::UnitX(), 45));
        centre = {dice.between(-0.1, 0.1), dice.between(-0.8, 0.8) * radius, 0.5 * length};
        stands = turn_about(Vec3::UnitZ(), dice.between(0, 360)) * turn_about(Vec3::UnitY(), 90);
        pivot = {centre.x(), 0, 0};
    }

    Configuration at(double angle)
    {
        const Quat turn(Eigen::AngleAxisd(angle, axis));
        poses[0] = pose_of(pivot + turn * (centre - pivot), turn * stands);
        return {geometry, poses};
    }
};

TEST(Rocking, EachEndOfAChordIsAContactOfItsOwn)
{
    constexpr double angle = 1e-3; // of a rock in a step [rad]
    for (int seed = 1; seed <= 200; ++seed) {
        Dice dice(seed);
        OnRidge scene(dice);
        std::set<Feature> all;
        for (const double turned : {-angle, 0.0, angle}) {
            std::vector<Candidate> found;
            const Configuration now = scene.at(turned);
            find_candidates({0, 1}, now, 1e-3, found);
            for (const Candidate& c : found) {
                all.insert(c.feature);
            }
        }
        EXPECT_EQ(all.size(), 2U) << seed; // the same two on either side
        for (const Feature& f : all) {
            const Touch flat = touch_of(f, scene.at(0));
            EXPECT_NEAR(flat.gap, 0, 1e-15) << seed;
            for (const double turned : {-angle, -1e-2 * angle, 1e-2 * angle, angle}) {
                const Touch touch = touch_of(f, scene.at(turned));
                // the rod has turned by that, and the chord is as long as the rod is wide at most;
                // near its ends the normal turns more, by the radius over the half chord
                EXPECT_LE((touch.normal - flat.normal).norm(), 3 * std::abs(turned)) << seed;
                EXPECT_LE((touch.point - flat.point).norm(), 0.3 * std::abs(turned)) << seed;
                const double lever = flat.point.x() - scene.pivot.x();
                EXPECT_NEAR(touch.gap, -turned * lever, 0.3 * sq(turned)) << seed;
            }
        }
    }
}

} // namespace
} // namespace hyoryu::test_rocking
