// SPDX-License-Identifier: MIT
#include "hyoryu/core/motion.hpp"

#include <gtest/gtest.h>

namespace hyoryu::test_motion {
namespace {

Motion path()
{
    return {{}, {0.0, 0.5, 2.0, 2.5}, {{0, 0, 0}, {0.2, 0, 0}, {1, 0, -0.1}, {1, 0, 0.3}}};
}

TEST(Motion, PassesThroughItsPointsAndRestsOutside)
{
    const Motion motion = path();
    for (std::size_t k = 0; k < motion.times.size(); ++k) {
        EXPECT_NEAR((displacement(motion, motion.times[k]) - motion.places[k]).norm(), 0, 1e-15);
    }
    EXPECT_EQ(displacement(motion, -1), motion.places.front());
    EXPECT_EQ(displacement(motion, 9), motion.places.back());
    EXPECT_EQ(velocity(motion, 9), Vec3(Vec3::Zero()));
}

TEST(Motion, VelocityIsTheDerivativeOfTheDisplacementAndHasNoJumps)
{
    const Motion motion = path();
    constexpr double h = 1e-6; // central differences: h^2 u''' / 6 and round-off / h
    for (double t = 0.01; t < 2.5; t += 0.01) {
        const Vec3 rate = (displacement(motion, t + h) - displacement(motion, t - h)) / (2 * h);
        EXPECT_NEAR((rate - velocity(motion, t)).norm(), 0, 1e-5) << t;
    }
    for (const double t : motion.times) {
        const Vec3 jump = velocity(motion, t + 1e-9) - velocity(motion, t - 1e-9);
        EXPECT_NEAR(jump.norm(), 0, 1e-7) << t;
    }
}

TEST(Motion, DoesNotOvershootAndStaysBelowItsSpeedBound)
{
    const Motion motion = path();
    for (double t = 0; t <= 2.5; t += 0.001) {
        EXPECT_LE(displacement(motion, t).x(), 1 + 1e-15);
        EXPECT_LE(velocity(motion, t).norm(), speed_bound(motion, t - 1e-3, t + 1e-3) + 1e-12);
    }
}

TEST(Motion, OfConstantVelocityNeedsNoPoints)
{
    const Motion motion{{2, 0, 0}, {}, {}};
    EXPECT_EQ(displacement(motion, 3), Vec3(6, 0, 0));
    EXPECT_EQ(speed_bound(motion, 0, 1), 2);
}

} // namespace
} // namespace hyoryu::test_motion
