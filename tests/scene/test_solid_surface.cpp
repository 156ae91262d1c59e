// SPDX-License-Identifier: MIT
// Distances to the surfaces of walls and bodies, and the way out of them.
#include "hyoryu/scene/solid_surface.hpp"

#include "scene/surfaces/way_out.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace hyoryu::test_solid_surface {
namespace {

Vec3 random_point(std::mt19937& random, double reach)
{
    std::uniform_real_distribution<double> number(-reach, reach);
    const double x = number(random);
    const double y = number(random);
    return {x, y, number(random)};
}

SolidSurface surface_of(const Shape& shape, int dimensions)
{
    BodySettings body;
    body.shape = shape;
    return surface_of(body, dimensions);
}

// The surface of a ring about z: not convex, and every feature of it is met.
MeshShape ring(double radius, double thickness, int sides)
{
    MeshShape mesh;
    const int round = 12;
    for (int k = 0; k < sides; ++k) {
        for (int j = 0; j < round; ++j) {
            const double a = 2 * std::numbers::pi * k / sides;
            const double b = 2 * std::numbers::pi * j / round;
            const double r = radius + thickness * std::cos(b);
            mesh.corners.emplace_back(r * std::cos(a), r * std::sin(a), thickness * std::sin(b));
        }
    }
    const auto at = [&](int k, int j) { return (k % sides) * round + j % round; };
    for (int k = 0; k < sides; ++k) {
        for (int j = 0; j < round; ++j) {
            mesh.triangles.push_back({at(k, j), at(k + 1, j), at(k + 1, j + 1)});
            mesh.triangles.push_back({at(k, j), at(k + 1, j + 1), at(k, j + 1)});
        }
    }
    return mesh;
}

// Two boxes that overlap, as a building in an STL file often is.
MeshShape two_boxes()
{
    MeshShape mesh;
    for (const double x : {-0.2, 0.2}) {
        const int first = static_cast<int>(mesh.corners.size());
        for (int k = 0; k < 8; ++k) {
            mesh.corners.emplace_back(x + ((k & 1) != 0 ? 0.4 : -0.4), (k & 2) != 0 ? 0.3 : -0.3,
                                      (k & 4) != 0 ? 0.5 : -0.5);
        }
        for (const auto& t : std::vector<std::array<int, 3>>{{0, 2, 1},
                                                             {1, 2, 3},
                                                             {4, 5, 6},
                                                             {5, 7, 6},
                                                             {0, 1, 4},
                                                             {1, 5, 4},
                                                             {2, 6, 3},
                                                             {3, 6, 7},
                                                             {0, 4, 2},
                                                             {2, 4, 6},
                                                             {1, 3, 5},
                                                             {3, 7, 5}}) {
            mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
        }
    }
    return mesh;
}

// The distance over all triangles, with the sign of the winding number, is the reference.
TEST(SolidSurface, TheTreeFindsTheDistanceOfAllTriangles)
{
    std::mt19937 random(1);
    for (const MeshShape& mesh : {ring(0.6, 0.2, 40), ring(0.5, 0.05, 7), two_boxes()}) {
        const Shape shape = mesh;
        const SolidSurface surface = surface_of(shape, 3);
        for (int k = 0; k < 2000; ++k) {
            const Vec3 p = random_point(random, 1.0);
            const double exact = signed_distance({.shape = &shape}, p);
            EXPECT_NEAR(nearest_place(surface, p).distance, exact, 1e-12) << p.transpose();
            const double near = nearest_place(surface, p, 0.1).distance;
            EXPECT_EQ(near < infinity, std::abs(exact) < 0.1);
        }
    }
}

// The way out along an axis, against the distance over all triangles: inside up to there, and
// outside behind. A lattice of places meets edges and corners of the boxes, too.
TEST(SolidSurface, AWayOutAlongAnAxisEndsWhereTheSolidEnds)
{
    std::mt19937 random(5);
    for (const MeshShape& mesh : {ring(0.63, 0.2, 40), ring(0.5, 0.05, 7), two_boxes()}) {
        const Shape shape = mesh;
        const auto tree = std::get<TriangleTree>(surface_of(shape, 3).shape);
        const auto outside = [&](const Vec3& p) { return signed_distance({.shape = &shape}, p); };
        int ways = 0;
        for (int k = 0; k < 3000; ++k) {
            const Vec3 drawn = random_point(random, 0.9);
            const Vec3 p = k % 2 == 0 ? drawn : Vec3(0.1 * (10 * drawn).array().round());
            if (outside(p) > -1e-3) {
                continue;
            }
            const int axis = k % 3;
            const int sense = k % 4 < 2 ? 1 : -1;
            const Vec3 step = sense * Vec3::Unit(axis);
            const WayOut out = way_out(tree, p, {axis, sense}, 10);
            ++ways;
            ASSERT_LT(out.distance, 10) << p.transpose();
            EXPECT_GT(outside(p + (out.distance + 1e-5) * step), 0) << p.transpose();
            for (int part = 1; part < 20; ++part) {
                const double s = (out.distance - 1e-9) * part / 20;
                EXPECT_LT(outside(p + s * step), 0) << p.transpose();
            }
            EXPECT_GT(out.normal[axis] * sense, 0);
            EXPECT_EQ(way_out(tree, p, {axis, sense}, 0.9 * out.distance).distance, infinity);
        }
        EXPECT_GT(ways, 10);
    }
}

// Every shape: the normal is the gradient, and a step of the distance along it ends on the surface.
TEST(SolidSurface, NormalsLeadToTheSurface)
{
    std::mt19937 random(2);
    ParticleShape cubes{.spacing = 0.2, .points = {{-0.1, 0, 0}, {0.1, 0, 0}, {0.1, 0, 0.2}}};
    const std::vector<Shape> shapes{BoxShape{{0.6, 0.4, 0.8}}, SphereShape{0.4},
                                    CylinderShape{0.3, 0.9}, ring(0.5, 0.2, 24), cubes};
    for (const Shape& shape : shapes) {
        const SolidSurface surface = surface_of(shape, 3);
        for (int k = 0; k < 500; ++k) {
            const Vec3 p = random_point(random, 0.9);
            const NearestPlace place = nearest_place(surface, p);
            EXPECT_NEAR(place.normal.norm(), 1, 1e-9);
            const Vec3 foot = p - place.distance * place.normal;
            EXPECT_NEAR(nearest_place(surface, foot).distance, 0, 1e-9) << p.transpose();
        }
    }
}

// Cubes that share a face have no surface there.
TEST(SolidSurface, ABodyOfCubesIsTheirUnion)
{
    const ParticleShape cubes{.spacing = 0.2, .points = {{-0.1, 0, 0}, {0.1, 0, 0}}};
    const SolidSurface surface = surface_of(cubes, 3);
    EXPECT_NEAR(nearest_place(surface, {0, 0, 0}).distance, -0.1, 1e-12);
    EXPECT_NEAR(nearest_place(surface, {0, 0, 0.13}).distance, 0.03, 1e-12);
    EXPECT_NEAR(nearest_place(surface, {0.24, 0, 0.13}).distance, 0.05, 1e-12);
}

TEST(SolidSurface, ABasinIsItsSides)
{
    Wall wall;
    wall.geometry = BasinWall{{0, 0, 0}, {2, 1, 1}, {false, false, false, false, false, true}};
    const SolidSurface basin = surface_of(wall, 0.1, 3);
    const auto distance = [&](const Vec3& p) { return nearest_place(basin, p).distance; };
    EXPECT_NEAR(distance({0.3, 0.5, 0.2}), 0.2, 1e-12) << "over the floor";
    EXPECT_NEAR(distance({0.1, 0.5, 0.7}), 0.1, 1e-12) << "beside a side";
    EXPECT_NEAR(distance({-0.02, 0.5, 0.7}), -0.02, 1e-12) << "in a side";
    EXPECT_NEAR(distance({-0.09, 0.5, 0.7}), -0.01, 1e-12) << "near its outside";
    EXPECT_NEAR(distance({-0.03, 0.5, -0.04}), -0.05, 1e-12) << "in an edge";
    EXPECT_NEAR(distance({-0.05, 0.5, 1.3}), 0.3, 1e-12) << "above the rim";
    EXPECT_NEAR(distance({0.3, 0.5, 1.4}), 0.5, 1e-12) << "to the edge of the rim";
    EXPECT_NEAR(distance({-0.4, 0.5, 0.5}), 0.3, 1e-12) << "outside";
    EXPECT_LT((nearest_place(basin, {-0.02, 0.5, 0.7}).normal - Vec3::UnitX()).norm(), 1e-12);
    const SolidSurface section = surface_of(wall, 0.1, 2);
    EXPECT_NEAR(nearest_place(section, {1, 0, 0.3}).distance, 0.3, 1e-12) << "no sides across";
}

} // namespace
} // namespace hyoryu::test_solid_surface
