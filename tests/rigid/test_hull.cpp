// SPDX-License-Identifier: MIT
// Convex hulls of corners in single precision, as meshes come: none of their faces is quite plane.
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace hyoryu::test_hull {
namespace {

constexpr double pi = 3.14159265358979323846;

struct Frustum {
    int sides = 4;
    double low = 0, high = 0; // radius of the corners [m]
    double height = 0;        // [m]
};

double volume(const Frustum& f)
{
    const double area = 0.5 * f.sides * std::sin(2 * pi / f.sides); // over the square of the radius
    return area * f.height / 3 * (f.low * f.low + f.low * f.high + f.high * f.high);
}

// The corners at a random turn and in a random order, in single precision.
std::vector<Vec3> corners(const Frustum& f, std::mt19937& random)
{
    std::normal_distribution<double> normal;
    const Quat turn =
        Quat(normal(random), normal(random), normal(random), normal(random)).normalized();
    std::vector<Vec3> list;
    for (int k = 0; k < f.sides; ++k) {
        const double angle = 2 * pi * k / f.sides;
        const Vec3 out(std::cos(angle), std::sin(angle), 0);
        list.push_back(f.low * out);
        list.push_back(f.high * out + Vec3(0, 0, f.height));
    }
    for (Vec3& x : list) {
        x = (turn * x).cast<float>().cast<double>();
    }
    std::shuffle(list.begin(), list.end(), random);
    return list;
}

// Each edge bounds one face on either side.
bool is_closed(const Polytope& hull)
{
    std::set<std::pair<int, int>> edges;
    std::size_t count = 0;
    for (const auto& face : hull.faces) {
        for (std::size_t k = 0; k < face.size(); ++k, ++count) {
            edges.insert({face[k], face[(k + 1) % face.size()]});
        }
    }
    return edges.size() == count && std::ranges::all_of(edges, [&](const auto& edge) {
               return edges.contains({edge.second, edge.first});
           });
}

TEST(Hull, OfFrustaInSinglePrecisionIsWholeInAnyOrder)
{
    std::mt19937 random(1);
    const auto between = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    };
    for (int draw = 0; draw < 2000; ++draw) {
        const double size = std::pow(10.0, between(-3, 3));
        const Frustum f{3 + draw % 10, size * between(0.2, 1), size * between(0.2, 1),
                        size * between(0.2, 4)};
        const Polytope hull = convex_hull(corners(f, random));
        EXPECT_EQ(hull.corners.size(), 2u * static_cast<unsigned>(f.sides)) << draw;
        EXPECT_EQ(hull.faces.size(), 2u + static_cast<unsigned>(f.sides)) << draw;
        EXPECT_TRUE(is_closed(hull)) << draw;
        // Corners are off by 6e-8 of the size at most; the volume by some of these.
        EXPECT_NEAR(mass_properties(hull, 1, 3).mass, volume(f), 2e-6 * volume(f)) << draw;
    }
}

} // namespace
} // namespace hyoryu::test_hull
