// SPDX-License-Identifier: MIT
// Faces of bodies in cells, and what lies opposite them.
#include "../../src/coupling/joint_faces.hpp"
#include "../../src/coupling/joint_surface.hpp"

#include "dice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hyoryu::test_joint_surface {
namespace {

double area(const BodyFaces& body, const Vec3& normal)
{
    double total = 0;
    for (const JointCell& cell : body.cells) {
        const JointFace& face = body.faces[static_cast<std::size_t>(cell.face)];
        total += face.normal.dot(normal) > 0.999 ? cell.area : 0;
    }
    return total;
}

TEST(JointFaces, CellsHaveTheAreaOfTheirFace)
{
    const JointScale scale{0.1, 0.1, 0.3, 3};
    const BodyFaces box = joint_faces(box_polytope({1, 0.7, 0.43}, 3), {}, scale);
    EXPECT_EQ(box.faces.size(), 6);
    EXPECT_NEAR(area(box, -Vec3::UnitZ()), 0.7, 1e-12);
    EXPECT_NEAR(area(box, Vec3::UnitY()), 0.43, 1e-12);
    const BodyFaces drum = joint_faces(Rod{0.5, 1}, {}, scale);
    EXPECT_EQ(drum.faces.size(), 2); // caps; what rests on its side rests on a line
    EXPECT_NEAR(area(drum, Vec3::UnitX()), std::numbers::pi / 4, 1e-12);
    const BodyFaces plate = joint_faces(box_polytope({1, 0, 0.1}, 2), {}, {0.1, 0.1, 0.3, 2});
    EXPECT_EQ(plate.faces.size(), 2); // its ends are narrower than 1.5 spacings
    EXPECT_NEAR(area(plate, Vec3::UnitZ()), 1, 1e-12);
}

TEST(JointFaces, PartsThatCoverEachOtherHaveNoCellsThere)
{
    Compound pair{{box_polytope({1, 1, 1}, 3), box_polytope({1, 1, 1}, 3)}};
    for (Vec3& corner : pair.parts[1].corners) {
        corner += Vec3(1, 0, 0);
    }
    const BodyFaces body = joint_faces(pair, {}, {0.1, 0.1, 0.3, 3});
    EXPECT_NEAR(area(body, Vec3::UnitX()), 1, 1e-12); // of the second alone
    EXPECT_NEAR(area(body, -Vec3::UnitZ()), 2, 1e-12);
}

TEST(JointSurface, RaysEnterWhereGeometrySays)
{
    const RaySolid box = ray_solid(box_polytope({2, 2, 2}, 3), 3);
    const auto top = enters(box, {{0.3, 0.2, 3}, {0, 0, -1}});
    ASSERT_TRUE(top);
    EXPECT_NEAR(top->enter, 2, 1e-14);
    EXPECT_NEAR(top->normal.z(), 1, 1e-14);
    EXPECT_FALSE(enters(box, {{1.3, 0.2, 3}, {0, 0, -1}}));
    EXPECT_FALSE(enters(box, {{0.3, 0.2, 3}, {0, 0, 1}})); // behind
    const RaySolid drum = ray_solid(Rod{0.5, 2}, 3);
    const auto side = enters(drum, {{0.4, 0, 2}, {0, 0, -1}});
    ASSERT_TRUE(side);
    EXPECT_NEAR(side->enter, 1.5, 1e-14);
    EXPECT_NEAR(enters(drum, {{3, 0.1, 0.1}, {-1, 0, 0}})->enter, 2, 1e-14);
    const auto ball = enters(ray_solid(Ball{0.5}, 3), {{0.3, 0, 2}, {0, 0, -1}});
    ASSERT_TRUE(ball);
    EXPECT_NEAR(ball->enter, 1.6, 1e-14);
    EXPECT_NEAR(ball->normal.x(), 0.6, 1e-14);
}

// A solid that a part of a ray is said not to come near must not be met there. The place is found
// by steps along the ray and the distance of each from the surface.
TEST(JointSurface, SolidsThatAreSkippedAreNotMet)
{
    Dice dice(6);
    const auto within = [&](double size) {
        const double x = dice.between(-size, size);
        const double y = dice.between(-size, size);
        return Vec3(x, y, dice.between(-size, size));
    };
    int skipped = 0;
    for (int n = 0; n < 600; ++n) {
        const Vec3 sides = Vec3(1.1, 1.1, 1.1) + within(1);
        const RaySolid solid = n % 3 == 0   ? ray_solid(box_polytope(sides, 3), 3)
                               : n % 3 == 1 ? ray_solid(Rod{sides.x() / 2, sides.y()}, 3)
                                            : ray_solid(Ball{sides.x() / 2}, 3);
        const Ray ray{within(1.5), within(1).normalized()};
        const RayPart part{dice.between(-1, 0), dice.between(0, 2)};
        if (comes_near(ray, part, Vec3(0, 0, 0), solid.reach)) {
            continue;
        }
        skipped += 1;
        for (int k = 0; k <= 100; ++k) {
            const double way = std::lerp(part.from, part.to, k / 100.0);
            EXPECT_GT(distance(solid, ray.origin + way * ray.direction), 0);
        }
    }
    EXPECT_GT(skipped, 200);
    EXPECT_LT(skipped, 500);
}

TEST(JointSurface, WallsOfEveryShapeAreMet)
{
    const Ray down{{0.4, 0.4, 2}, {0, 0, -1}};
    Boundary wall;
    wall.surface = Plane{{0, 0, 0.5}, {0, 0, 1}};
    EXPECT_NEAR(enters(ray_wall(wall, 3), down, {-1, 3})->enter, 1.5, 1e-14);
    wall.surface = Basin{{0, 0, 0.25}, {1, 1, 3}, {false, false, false, false, false, true}};
    EXPECT_NEAR(enters(ray_wall(wall, 3), down, {-1, 3})->enter, 1.75, 1e-14);
    EXPECT_NEAR(enters(ray_wall(wall, 3), {{0.4, 0.4, 2}, {1, 0, 0}}, {-1, 3})->enter, 0.6, 1e-14);
    EXPECT_FALSE(enters(ray_wall(wall, 3), {{0.4, 0.4, 2}, {0, 0, 1}}, {-1, 3})); // open above
    wall.surface = Obstacle{box_polytope({1, 1, 1}, 3), {0.5, 0.5, 0}};
    EXPECT_NEAR(enters(ray_wall(wall, 3), down, {-1, 3})->enter, 1.5, 1e-14);
    MeshSurface mesh;
    mesh.corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    wall.surface = mesh;
    const auto hit = enters(ray_wall(wall, 3), down, {-1, 3});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->enter, 1.6, 1e-14);
    EXPECT_NEAR(hit->normal.y(), -std::sqrt(0.5), 1e-14);
}

} // namespace
} // namespace hyoryu::test_joint_surface
