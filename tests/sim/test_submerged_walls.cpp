// SPDX-License-Identifier: MIT
// Walls under still water, of any thickness: the water acts on them as Archimedes says.
#include "hyoryu/sim/frames.hpp"
#include "hyoryu/sim/gauges.hpp"

#include "dice.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hyoryu::test_submerged_walls {
namespace {

constexpr double rho = 1000, g = 9.81;

// A tank with a wall in its middle; depth, width and length in spacings. 2-D if it has no width.
std::string tank(double spacing, const Vec3& size, const std::string& wall)
{
    const Vec3 most = spacing * size;
    return fmt::format("dimensions = {0}\n[time]\nend = 9\n[particles]\nspacing = {1}\n[fluid]\n"
                       "density = {2}\n[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\n"
                       "max = [{3}, {4}, {5}]\n[[wall]]\nname = \"tank\"\nshape = \"basin\"\n"
                       "min = [0, 0, 0]\nmax = [{3}, {4}, {6}]\nopen = [\"+z\"]\n[[wall]]\n"
                       "name = \"wall\"\n{7}[[gauge]]\nname = \"f\"\ntype = \"force\"\n"
                       "on = \"wall\"\n",
                       size.y() > 0 ? 3 : 2, spacing, rho, most.x(), most.y(), most.z(),
                       most.z() + 4 * spacing, wall);
}

Simulation started(const Scene& scene)
{
    const Filling filling = fill(scene);
    return make_simulation(scene, make_plan(scene, filling), filling);
}

// The volume of water whose weight the water lifts the wall by, averaged over some time after its
// first motion; `depth` of the water [m].
double lifted_volume(Simulation sim, double depth)
{
    const double settled = std::sqrt(depth / g);
    double sum = 0;
    int steps = 0;
    while (sim.clock.time < 3 * settled) {
        step_on(sim);
        if (sim.clock.time > settled) {
            sum += read_gauges(sim).at(2);
            ++steps;
        }
    }
    return sum / steps / (rho * g);
}

// How far the surface that the water sees stands off that of the wall, all round [spacings].
double stand_off(double lifted, double volume, double surface, double spacing)
{
    return (lifted - volume) / surface / spacing;
}

TEST(SubmergedWalls, BoxesOfAnyEdgesDisplaceTheirVolume)
{
    Dice dice(71);
    for (int n = 0; n < 12; ++n) {
        const double dp = n % 2 == 0 ? 0.05 : 0.02;
        const double thick = dice.between(1.6, 4.5) * dp;
        const double wide = dice.between(3, 8) * dp;
        const double z = dice.between(6, 7) * dp;
        const bool upright = dice.chance(0.5);
        const std::string box =
            fmt::format("shape = \"box\"\nsize = [{}, 0, {}]\nposition = [{}, 0, {}]\n",
                        upright ? thick : wide, upright ? wide : thick, 10 * dp, z);
        const double lifted = lifted_volume(make(tank(dp, {20, 0, 14}, box)), 14 * dp);
        EXPECT_LT(std::abs(stand_off(lifted, thick * wide, 2 * (thick + wide), dp)), 0.04)
            << thick / dp << " x " << wide / dp << " spacings, at " << z / dp;
    }
}

TEST(SubmergedWalls, BallsAndRodsOfAnyRadiusDisplaceTheirVolume)
{
    Dice dice(74);
    for (int n = 0; n < 6; ++n) {
        const double dp = n % 2 == 0 ? 0.05 : 0.02;
        const double r = dice.between(1.3, 3.5) * dp;
        const double length = dice.between(3, 7) * dp;
        const bool ball = n < 3;
        const double pi = std::numbers::pi;
        const double volume = ball ? 4 * pi / 3 * r * r * r : pi * r * r * length;
        const double surface = ball ? 4 * pi * r * r : 2 * pi * r * (r + length);
        const std::string shape =
            ball ? fmt::format("shape = \"sphere\"\nradius = {}\n", r)
                 : fmt::format("shape = \"cylinder\"\nradius = {}\nlength = {}\n", r, length);
        const std::string place =
            fmt::format("position = [{}, {}, {}]\n", 7 * dp, 6 * dp, dice.between(6, 7) * dp);
        const double lifted = lifted_volume(make(tank(dp, {14, 12, 13}, shape + place)), 13 * dp);
        EXPECT_LT(std::abs(stand_off(lifted, volume, surface, dp)), 0.04)
            << (ball ? "ball" : "rod") << ", radius of " << r / dp << " spacings, displaces "
            << lifted / volume << " of its volume";
    }
}

// A deck on a rib, along y; its box has other edges than the deck, so that the lattice in it fits
// neither of them. Turned about y.
struct Deck {
    double length = 0, thick = 0, rib = 0, high = 0; // in the section [m]
    double width = 0;                                // along y [m]
    double angle = 0;                                // [rad]

    double volume() const { return width * (length * thick + rib * high); }
    double surface() const { return 2 * volume() / width + 2 * width * (length + thick + high); }
    MeshShape mesh() const
    {
        const std::array<std::array<double, 2>, 8> section{{{-length / 2, 0},
                                                            {length / 2, 0},
                                                            {length / 2, thick},
                                                            {rib / 2, thick},
                                                            {rib / 2, thick + high},
                                                            {-rib / 2, thick + high},
                                                            {-rib / 2, thick},
                                                            {-length / 2, thick}}};
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        MeshShape mesh;
        for (const double y : {-width / 2, width / 2}) {
            for (const auto& [x, z] : section) {
                mesh.corners.emplace_back(c * x - s * z, y, s * x + c * z);
            }
        }
        for (const auto& [i, j, k] : std::to_array<std::array<int, 3>>(
                 {{0, 1, 2}, {0, 2, 3}, {0, 3, 6}, {0, 6, 7}, {3, 4, 5}, {3, 5, 6}})) {
            mesh.triangles.push_back({i, j, k});
            mesh.triangles.push_back({i + 8, k + 8, j + 8});
        }
        for (int k = 0; k < 8; ++k) {
            const int next = (k + 1) % 8;
            mesh.triangles.push_back({k, k + 8, next});
            mesh.triangles.push_back({next, k + 8, next + 8});
        }
        return mesh;
    }
};

// Upright and turned by up to 17 degrees; of 40 draws the largest stands off by 0.05 spacings, and
// by 0.1 if the rows of thin parts do not share their thickness.
TEST(SubmergedWalls, MeshesWhoseSurfacesCutTheirLatticeDisplaceTheirVolume)
{
    Dice dice(72);
    for (int n = 0; n < 8; ++n) {
        const double dp = n % 2 == 0 ? 0.05 : 0.02;
        const Deck deck{.length = dice.between(6, 8) * dp,
                        .thick = dice.between(1.6, 4) * dp,
                        .rib = dice.between(2, 3) * dp,
                        .high = dice.between(1.5, 3.5) * dp,
                        .width = dice.between(5, 7) * dp,
                        .angle = n < 4 ? 0 : dice.between(-0.3, 0.3)};
        const std::string box =
            fmt::format("shape = \"box\"\nsize = [1, 1, 1]\nposition = [{}, {}, {}]\n", 8 * dp,
                        6 * dp, dice.between(4, 5) * dp);
        Scene scene = parse_case(tank(dp, {16, 12, 14}, box), "tank.toml");
        std::get<SolidWall>(scene.walls[1].geometry).shape = deck.mesh();
        const double lifted = lifted_volume(started(scene), 14 * dp);
        EXPECT_LT(std::abs(stand_off(lifted, deck.volume(), deck.surface(), dp)), 0.06)
            << deck.thick / dp << " spacings thick, turned by " << deck.angle << ", displaces "
            << lifted / deck.volume() << " of its volume";
    }
}

// A pier, a wedge or a plate: a convex polygon, counter-clockwise, with a height along z, turned.
struct Prism {
    std::vector<std::array<double, 2>> corners; // [m]
    double height = 0;                          // [m]
    Quat turn = Quat::Identity();

    double area() const
    {
        double twice = 0;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const auto& [x, y] = corners[k];
            const auto& [u, v] = corners[(k + 1) % corners.size()];
            twice += x * v - y * u;
        }
        return twice / 2;
    }
    double volume() const { return area() * height; }
    double surface() const
    {
        double round = 0;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const auto& [x, y] = corners[k];
            const auto& [u, v] = corners[(k + 1) % corners.size()];
            round += std::hypot(u - x, v - y);
        }
        return 2 * area() + round * height;
    }
    MeshShape mesh() const
    {
        MeshShape mesh;
        for (const auto& [x, y] : corners) {
            mesh.corners.push_back(turn * Vec3(x, y, -height / 2));
            mesh.corners.push_back(turn * Vec3(x, y, height / 2));
        }
        const auto sides = static_cast<int>(corners.size());
        for (int k = 0; k < sides; ++k) {
            const int next = (k + 1) % sides;
            mesh.triangles.push_back({2 * k, 2 * next, 2 * next + 1});
            mesh.triangles.push_back({2 * k, 2 * next + 1, 2 * k + 1});
            if (k > 0 && next > 0) {
                mesh.triangles.push_back({0, 2 * next, 2 * k});
                mesh.triangles.push_back({1, 2 * k + 1, 2 * next + 1});
            }
        }
        return mesh;
    }
};

Prism drawn_prism(Dice& dice, double dp)
{
    Prism prism;
    const int sides = dice.below(5) + 2;
    const double radius = dice.between(2.5, 4) * dp;
    if (sides == 2) { // a plate
        const double x = dice.between(3, 5) * dp;
        const double y = dice.between(0.5, 1.5) * dp;
        prism.corners = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
    } else {
        for (int k = 0; k < sides; ++k) {
            const double angle = 2 * std::numbers::pi * k / sides;
            prism.corners.push_back({radius * std::cos(angle), radius * std::sin(angle)});
        }
    }
    prism.height = dice.between(4, 7) * dp;
    const auto random = [&] { return dice.between(-1, 1); };
    const double angle = dice.chance(0.2) ? std::numbers::pi / 4 : std::numbers::pi * random();
    const Vec3 axis = dice.chance(0.5) ? Vec3(0, 0, 1) : Vec3{random(), random(), random()};
    prism.turn = Eigen::AngleAxisd(angle, axis.normalized());
    return prism;
}

Scene with_prism(const Prism& prism, double dp, const Vec3& size, const Vec3& place,
                 const std::string& more)
{
    const std::string box =
        fmt::format("shape = \"box\"\nsize = [1, 1, 1]\nposition = [{}, {}, {}]\n", place.x(),
                    place.y(), place.z());
    Scene scene = parse_case(tank(dp, size, box) + more, "tank.toml");
    std::get<SolidWall>(scene.walls[1].geometry).shape = prism.mesh();
    return scene;
}

// The cells of a lattice whose middles lie within a mesh have 0.7 to 1.3 of its volume, the least
// in prisms at 45 degrees, whose faces pass through the middles of a layer. Here the cells are cut.
TEST(SubmergedWalls, MeshesAtAnyAngleHaveTheirVolume)
{
    Dice dice(76);
    for (int n = 0; n < 80; ++n) {
        const double dp = n % 2 == 0 ? 0.05 : 0.02;
        const Prism prism = drawn_prism(dice, dp);
        const Vec3 offset{dice.between(0, 1), dice.between(0, 1), dice.between(0, 1)};
        const Scene scene = with_prism(prism, dp, {6, 5, 3}, dp * (Vec3(40, 5, 5) + offset),
                                       "[output]\nevery = 1\nfields = [\"volume\"]\n");
        const Cloud cloud = wall_cloud(started(scene));
        const auto& volumes = std::get<std::vector<float>>(
            std::ranges::find(cloud.columns, "Volume", &Column::name)->values);
        double sum = 0;
        for (std::size_t k = 0; k < volumes.size(); ++k) {
            sum += cloud.points[3 * k] > 25 * dp ? volumes[k] : 0;
        }
        EXPECT_LT(std::abs(stand_off(sum, prism.volume(), prism.surface(), dp)), 0.06)
            << "draw " << n << ": " << prism.corners.size() << " sides, " << sum / prism.volume()
            << " of its volume";
    }
}

TEST(SubmergedWalls, MeshesAtAnyAngleDisplaceTheirVolume)
{
    Dice dice(77);
    for (int n = 0; n < 8; ++n) {
        const double dp = n % 2 == 0 ? 0.05 : 0.02;
        const Prism prism = drawn_prism(dice, dp);
        const Vec3 offset{dice.between(0, 1), dice.between(0, 1), dice.between(0, 1)};
        const Scene scene =
            with_prism(prism, dp, {16, 16, 16}, dp * (Vec3(7.5, 7.5, 7) + offset), "");
        const double lifted = lifted_volume(started(scene), 16 * dp);
        EXPECT_LT(std::abs(stand_off(lifted, prism.volume(), prism.surface(), dp)), 0.06)
            << "draw " << n << ": " << prism.corners.size() << " sides, displaces "
            << lifted / prism.volume() << " of its volume";
    }
}

// A bed with a tower, whose lattice begins anywhere in the bed: flat, or sloping by up to 9
// degrees. On the lattice itself flat beds would be 0.13 to 0.18 spacings too low.
TEST(SubmergedWalls, WaterOverAMeshKeepsTheLevelItWasFilledTo)
{
    Dice dice(73);
    for (int n = 0; n < 4; ++n) {
        const double dp = n % 2 == 0 ? 0.05 : 0.02;
        const double thick = dice.between(7.5, 9.5) * dp;
        const double under = 3 * dp; // the floor of the tank
        const double level = thick - under + 10 * dp;
        const Deck bed{.length = 40 * dp,
                       .thick = thick,
                       .rib = 4 * dp,
                       .high = dice.between(3, 7) * dp,
                       .width = 20 * dp,
                       .angle = n < 2 ? 0 : dice.between(-0.15, 0.15)};
        const std::string keys = fmt::format(
            "shape = \"box\"\nsize = [1, 1, 1]\nposition = [{}, {}, {}]\n", 9 * dp, 6 * dp, -under);
        std::string text = tank(dp, {18, 12, level / dp}, keys);
        for (const double x : {3.0, 5.0, 13.0, 15.0}) {
            text += fmt::format("[[gauge]]\nname = \"e{0}\"\ntype = \"elevation\"\n"
                                "at = [{1}, {2}, 0]\n",
                                x, x * dp, 6 * dp);
        }
        Scene scene = parse_case(text, "bed.toml");
        std::get<SolidWall>(scene.walls[1].geometry).shape = bed.mesh();
        Simulation sim = started(scene);
        while (sim.clock.time < 4 * std::sqrt(level / g)) {
            step_on(sim);
        }
        const std::vector<double> row = read_gauges(sim);
        double mean = 0;
        for (std::size_t k = row.size() - 4; k < row.size(); ++k) {
            mean += row[k] / 4;
        }
        EXPECT_LT(std::abs(mean - level), 0.1 * dp) << bed.thick / dp << " spacings, sloping by "
                                                    << bed.angle << ": " << (mean - level) / dp;
    }
}

// Far from the water wall particles exist in frames alone.
TEST(SubmergedWalls, FramesHoldTheVolumesOfDryOnes)
{
    Dice dice(75);
    for (int n = 0; n < 6; ++n) {
        const double dp = n % 2 == 0 ? 0.05 : 0.02;
        const double thick = dice.between(0.6, 4.5) * dp;
        const double wide = dice.between(0.6, 6) * dp;
        const std::string box =
            fmt::format("shape = \"box\"\nsize = [{}, 0, {}]\nposition = [{}, 0, {}]\n", thick,
                        wide, 40 * dp, 5 * dp);
        const Simulation sim =
            make(tank(dp, {10, 0, 5}, box) + "[output]\nevery = 1\nfields = [\"volume\"]\n");
        const Cloud cloud = wall_cloud(sim);
        const auto& volumes = std::get<std::vector<float>>(
            std::ranges::find(cloud.columns, "Volume", &Column::name)->values);
        double sum = 0;
        for (std::size_t k = 0; k < volumes.size(); ++k) {
            sum += cloud.points[3 * k] > 25 * dp ? volumes[k] : 0;
        }
        EXPECT_NEAR(sum / (thick * wide), 1, 1e-5); // in single precision
    }
}

} // namespace
} // namespace hyoryu::test_submerged_walls
