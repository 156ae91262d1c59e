// SPDX-License-Identifier: MIT
// Which points of two boxes are in contact when their faces are all but flush.
#include "rigid/collision/narrow_phase.hpp"
#include "rigid/collision/separation.hpp"

#include <gtest/gtest.h>

namespace hyoryu::test_manifold {
namespace {

constexpr double side = 0.1; // of both boxes [m]

// Box 1 over a rim of box 0, turned about the vertical, tilted about a level axis of its own, and
// so far down that the nearest edges just meet.
struct TwoBoxes {
    Geometry geometry;
    std::vector<SolidPose> poses{pose_of({0, 0, 0}, Quat::Identity()), SolidPose{}};

    explicit TwoBoxes(double tilt)
    {
        geometry.solids.assign(2, solid_of(box_polytope({side, side, side}, 3), 3));
        const Quat turn(Eigen::AngleAxisd(0.5, Vec3::UnitZ()));
        const Quat roll(Eigen::AngleAxisd(tilt, Vec3(1, 3, 0).normalized()));
        poses[1] = pose_of({0.02, 0.04, 1.2 * side}, roll * turn);
        for (int k = 0; k < 4; ++k) { // the axis is not quite the vertical
            poses[1].x.z() -= distance().distance;
        }
    }

    Configuration at() const { return {geometry, poses}; }
    Separation distance() const
    {
        return separation(placed(at(), 0), placed(at(), 1), infinity, 1);
    }
    std::vector<Candidate> contacts() const
    {
        std::vector<Candidate> found;
        find_candidates({0, 1}, at(), clearly_apart(geometry), found);
        return found;
    }
};

// Faces at rest tilt by the round-off of their gaps; then only one crossing of their rims touches.
TEST(Manifold, FacesThatTiltByAlmostNothingKeepAllTheirContacts)
{
    for (const double tilt : {1e-5, 1e-4, 5e-4}) {
        const TwoBoxes boxes(tilt);
        const std::vector<Candidate> found = boxes.contacts();
        ASSERT_EQ(boxes.distance().kind, AxisKind::edges) << "or the case is no case";
        EXPECT_EQ(found.size(), 4u) << tilt;
        double lowest = infinity;
        for (const Candidate& c : found) {
            lowest = std::min(lowest, c.touch.gap);
            // No two points of a face are farther apart than its diagonal.
            EXPECT_LE(c.touch.gap, std::sqrt(2.0) * side * tilt);
        }
        // The normals of the face and of the edges make `tilt`, so their distances differ by its
        // square.
        EXPECT_NEAR(lowest, boxes.distance().distance, side * sq(tilt) + 1e-12) << tilt;
    }
}

TEST(Manifold, EdgesThatCrossAtAnAngleMeetInOnePoint)
{
    const TwoBoxes boxes(0.05);
    ASSERT_EQ(boxes.contacts().size(), 1u);
    EXPECT_EQ(boxes.contacts()[0].feature.kind, FeatureKind::edge_edge);
}

} // namespace
} // namespace hyoryu::test_manifold
