// SPDX-License-Identifier: MIT
// Particles in layers that follow a surface: round basins, blocks of fluid, meshes.
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/plan.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace hyoryu::test_fill_layers {
namespace {

constexpr double dp = 0.1;

// How far a depth is from the middle of a layer, in spacings.
double off_layer(double depth)
{
    return std::abs(depth / dp - std::floor(depth / dp) - 0.5);
}

TEST(FillLayers, RingsOfFluidMeetARoundBasin)
{
    const Scene scene = parse_case(R"(
dimensions = 2
[time]
end = 1.0
[particles]
spacing = 0.1
[fluid]
walls = "no_slip"
[[fluid.block]]
shape = "sphere"
radius = 1.0
position = [0.3, 0.0, 0.2]
layers = true
[[wall]]
name = "vessel"
shape = "round_basin"
radius = 1.0
position = [0.3, 0.0, 0.2]
[[body]]
name = "disc"
shape = "sphere"
radius = 0.5
density = 500.0
position = [0.3, 0.0, 0.2]
)",
                                   "t.toml");
    const Filling filling = fill(scene);
    const Vec3 centre(0.3, 0, 0.2);
    for (const Vec3& p : filling.fluid) {
        const double r = (p - centre).norm();
        EXPECT_GT(r, 0.5);
        EXPECT_LT(off_layer(1 - r), 1e-9);
    }
    // Area between the circles, whole particles a ring.
    EXPECT_NEAR(static_cast<double>(filling.fluid.size()), 235.6, 2);
    ASSERT_EQ(filling.wall_depth.size(), filling.wall.size());
    for (std::size_t k = 0; k < filling.wall.size(); ++k) {
        const double depth = (filling.wall[k] - centre).norm() - 1;
        EXPECT_NEAR(filling.wall_depth[k], depth, 1e-12);
        EXPECT_TRUE(depth > 0 && depth < 0.3);
        EXPECT_LT(off_layer(depth), 1e-9);
    }
    const Plan plan = make_plan(scene, filling);
    EXPECT_TRUE(std::any_of(plan.warnings.begin(), plan.warnings.end(), [](const Diagnostic& d) {
        return d.what.find("bounding box") != std::string::npos;
    }));
    EXPECT_EQ(to_toml(scene), to_toml(parse_case(to_toml(scene), "again.toml")));
}

// A wedge along y: two sides at 30 degrees below, a flat top.
TEST(FillLayers, MeshBodiesHaveLayersBelowTheirSides)
{
    Scene scene = parse_case(R"(
[time]
end = 1.0
[particles]
spacing = 0.1
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, -5.0]
max = [1.0, 1.0, -4.0]
[[body]]
name = "wedge"
shape = "box"
size = [1, 1, 1]
density = 500.0
position = [0.0, 0.0, 0.0]
)",
                             "t.toml");
    const double slope = std::tan(std::numbers::pi / 6);
    MeshShape mesh;
    for (const double y : {-1.0, 1.0}) {
        for (const auto& [x, z] : {std::pair(0.0, 0.0), {2.0, 2 * slope}, {-2.0, 2 * slope}}) {
            mesh.corners.emplace_back(x, y, z);
        }
    }
    mesh.triangles = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4}, {0, 4, 1},
                      {1, 4, 5}, {1, 5, 2}, {2, 5, 3}, {2, 3, 0}};
    scene.bodies[0].shape = mesh;
    const Filling filling = fill(scene);
    const std::vector<Vec3>& points = filling.bodies[0].points;
    const auto on_lattice = static_cast<double>(aggregate(mesh, dp, 3).points.size());
    // The layers have less room in the two tips of 30 degrees.
    EXPECT_NEAR(static_cast<double>(points.size()), on_lattice, 0.12 * on_lattice);
    EXPECT_NEAR(filling.bodies[0].particle_volume * static_cast<double>(points.size()),
                volume(mesh, 3), 1e-12);
    int in_layers = 0;
    double nearest = infinity;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec3& p = points[k];
        const double keel = (p.z() - std::abs(p.x()) * slope) * std::cos(std::numbers::pi / 6);
        EXPECT_GT(keel, 0.3 * dp) << p.transpose();
        // Away from the other sides and from the keel, where two sides are near.
        if (keel < 2.9 * dp && p.z() < 2 * slope - 4 * dp && std::abs(p.x()) > 6 * dp) {
            in_layers += 1;
            EXPECT_LT(off_layer(keel), 0.05);
        }
        for (std::size_t j = 0; j < k; ++j) {
            nearest = std::min(nearest, (p - points[j]).norm());
        }
    }
    EXPECT_GT(in_layers, 100);
    EXPECT_GT(nearest, 0.5 * dp);
}

// Crates on the floor of a tank that fits no lattice, two by two. A particle below one is pressed
// against it by the floor: it lifted the crate with the pressure of a whole cell.
TEST(FillLayers, NoParticleIsLeftUnderWhatStandsOnTheGround)
{
    std::mt19937 dice(17);
    std::uniform_real_distribution<double> part(0, 1);
    for (int k = 0; k < 200; ++k) {
        const double spacing = k % 2 == 0 ? 0.05 : 0.03;
        const double a = 0.3 + 0.2 * part(dice);
        const double b = 0.3 + 0.2 * part(dice);
        const double gap = spacing * (1 + 2 * part(dice));
        const double beside = 0.2 + 0.1 * part(dice);
        const double level = 0.2 + 0.2 * part(dice);
        const double end = 2 * beside + a + gap + b;
        const double left = beside + a / 2;
        const double right = beside + a + gap + b / 2;
        const auto crate = [](double width, double x) {
            return fmt::format("[[body]]\nshape = \"box\"\nsize = [{}, 0, 0.6]\n"
                               "density = 500\nposition = [{}, 0, 0.3]\n",
                               width, x);
        };
        const Filling filling =
            fill(parse_case(fmt::format("dimensions = 2\n[time]\nend = 1\n[particles]\n"
                                        "spacing = {}\n[fluid]\n[[fluid.block]]\nshape = \"box\"\n"
                                        "min = [0, 0, 0]\nmax = [{}, 0, {}]\n[[wall]]\n"
                                        "shape = \"basin\"\nmin = [0, 0, 0]\nmax = [{}, 0, 1]\n"
                                        "open = [\"+z\"]\n{}{}",
                                        spacing, end, level, end, crate(a, left), crate(b, right)),
                            "test.toml"));
        for (const Vec3& p : filling.fluid) {
            const double outside =
                std::min(std::abs(p.x() - left) - a / 2, std::abs(p.x() - right) - b / 2);
            EXPECT_GT(outside, 0) << k << ": " << p.transpose();
        }
    }
}

} // namespace
} // namespace hyoryu::test_fill_layers
