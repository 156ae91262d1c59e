// SPDX-License-Identifier: MIT
// Surfaces of shapes as triangles: closed, and seen from outside.
#include "hyoryu/scene/triangles.hpp"

#include "dice.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace hyoryu::test_triangles {
namespace {

// By the divergence theorem: positive if corners wind counter-clockwise from outside.
double enclosed(const TriangleSurface& surface)
{
    double volume = 0;
    for (const auto& triangle : surface.triangles) {
        const Vec3& a = surface.corners[static_cast<std::size_t>(triangle[0])];
        const Vec3& b = surface.corners[static_cast<std::size_t>(triangle[1])];
        const Vec3& c = surface.corners[static_cast<std::size_t>(triangle[2])];
        volume += a.dot(b.cross(c)) / 6;
    }
    return volume;
}

TEST(Triangles, WindCounterClockwiseFromOutside)
{
    Dice dice(static_cast<std::uint64_t>(number_from("HYORYU_SEED", 4)));
    const double pi = std::numbers::pi;
    for (int k = 0; k < 20; ++k) {
        const double radius = dice.between(0.01, 5);
        const double length = dice.between(0.01, 5);
        const Vec3 size(radius, length, dice.between(0.01, 5));
        EXPECT_NEAR(enclosed(triangles_of(BoxShape{size}, 3)) / size.prod(), 1, 1e-12);
        // 32 sides: 0.64 % of a circle; 16 bands take as much of a half circle again, and more of a
        // sphere, whose rings count by their squares.
        const double round = pi * radius * radius;
        EXPECT_NEAR(enclosed(triangles_of(CylinderShape{radius, length}, 3)) / (round * length), 1,
                    0.007);
        EXPECT_NEAR(enclosed(triangles_of(SphereShape{radius}, 3)) / (4 * round * radius / 3), 1,
                    0.02);
    }
}

} // namespace
} // namespace hyoryu::test_triangles
