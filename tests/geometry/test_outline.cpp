// SPDX-License-Identifier: MIT
// Outlines drawn at random and the prisms on them, against the shoelace formula, the divergence
// theorem and winding numbers.
#include "dice.hpp"
#include "hyoryu/geometry/outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyoryu::test_outline {
namespace {

constexpr double turn = 2 * std::numbers::pi;

// A star about a middle, which is simple whatever its radii: convex ones, concave ones, slits.
Ring star(Dice& dice, const Plan2& middle, double least, double most, int corners)
{
    Ring ring;
    for (int k = 0; k < corners; ++k) {
        const double angle = turn * (k + dice.between(0, 0.8)) / corners;
        const double r = dice.between(least, most);
        ring.push_back({middle[0] + r * std::cos(angle), middle[1] + r * std::sin(angle)});
    }
    return ring;
}

// A comb of right angles, with corners in straight lines as maps have them.
Ring comb(Dice& dice, const Plan2& corner, int teeth)
{
    const double depth = dice.between(2, 9);
    Ring ring{{corner[0], corner[1]}};
    for (int k = 0; k < teeth; ++k) {
        ring.push_back({corner[0] + 2 * k + 1, corner[1]});
        ring.push_back({corner[0] + 2 * k + 1, corner[1] + depth});
        ring.push_back({corner[0] + 2 * k + 2, corner[1] + depth});
        ring.push_back({corner[0] + 2 * k + 2, corner[1]});
    }
    ring.push_back({corner[0] + 2 * teeth + 1, corner[1]});
    ring.push_back({corner[0] + 2 * teeth + 1, corner[1] + depth + 3});
    ring.push_back({corner[0] + teeth, corner[1] + depth + 3}); // in a straight line
    ring.push_back({corner[0], corner[1] + depth + 3});
    return ring;
}

// The outline of case k: with up to four courtyards, in any direction, beginning anywhere.
std::vector<Ring> draw(Dice& dice, int k)
{
    const Plan2 middle{dice.between(-2e3, 2e3), dice.between(-2e3, 2e3)};
    std::vector<Ring> rings;
    if (k % 4 == 3) {
        rings.push_back(comb(dice, middle, 1 + dice.below(6)));
        const Plan2 hall{middle[0] + 1, middle[1] + rings[0][2][1] - middle[1] + 1.5};
        rings.push_back(star(dice, hall, 0.1, 0.7, 3 + dice.below(5)));
    } else {
        rings.push_back(star(dice, middle, k % 2 == 0 ? 9.9 : 5.0, 10, 3 + dice.below(40)));
        const int yards = k % 3 == 0 && rings[0].size() > 8 ? dice.below(5) : 0;
        for (int y = 0; y < yards; ++y) {
            const Plan2 at{middle[0] + (y % 2 == 0 ? 1 : -1) * 1.3,
                           middle[1] + (y < 2 ? 1 : -1) * 1.3};
            rings.push_back(star(dice, at, 0.2, 1.2, 3 + dice.below(12)));
        }
    }
    for (Ring& ring : rings) {
        std::rotate(ring.begin(), ring.begin() + dice.below(static_cast<int>(ring.size())),
                    ring.end());
        if (dice.chance(0.5)) {
            std::ranges::reverse(ring);
        }
    }
    return rings;
}

double shoelace(const Ring& ring)
{
    double sum = 0;
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const Plan2& p = ring[k];
        const Plan2& q = ring[(k + 1) % ring.size()];
        sum +=
            (p[0] - ring[0][0]) * (q[1] - ring[0][1]) - (q[0] - ring[0][0]) * (p[1] - ring[0][1]);
    }
    return std::abs(sum) / 2;
}

// Turns of a ring about a point, by the angles of its edges.
int winding(const Ring& ring, const Plan2& p)
{
    double sum = 0;
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const Plan2& a = ring[k];
        const Plan2& b = ring[(k + 1) % ring.size()];
        const double from = std::atan2(a[1] - p[1], a[0] - p[0]);
        const double to = std::atan2(b[1] - p[1], b[0] - p[0]);
        sum += std::remainder(to - from, turn);
    }
    return static_cast<int>(std::lround(sum / turn));
}

// Turns of a closed surface about a point, by solid angles (van Oosterom and Strackee 1983).
int winding(const Mesh& mesh, const Vec3& p)
{
    double sum = 0;
    for (const auto& t : mesh.triangles) {
        const auto from = [&](std::size_t k) {
            return Vec3(mesh.corners[static_cast<std::size_t>(t[k])] - p);
        };
        const Vec3 a = from(0);
        const Vec3 b = from(1);
        const Vec3 c = from(2);
        sum += std::atan2(a.dot(b.cross(c)), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                                 b.dot(c) * a.norm() + c.dot(a) * b.norm());
    }
    return static_cast<int>(std::lround(2 * sum / (2 * turn)));
}

double distance(const std::vector<Ring>& rings, const Plan2& p)
{
    double least = 1e300;
    for (const Ring& ring : rings) {
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const Plan2& a = ring[k];
            const Plan2& b = ring[(k + 1) % ring.size()];
            const double ux = b[0] - a[0];
            const double uy = b[1] - a[1];
            const double s = std::clamp(
                ((p[0] - a[0]) * ux + (p[1] - a[1]) * uy) / (ux * ux + uy * uy), 0.0, 1.0);
            least = std::min(least, std::hypot(p[0] - a[0] - s * ux, p[1] - a[1] - s * uy));
        }
    }
    return least;
}

TEST(Outlines, PrismsHaveTheVolumeAndTheInsideOfTheirRings)
{
    Dice dice(11);
    int with_yards = 0;
    for (int k = 0; k < 400; ++k) {
        const std::vector<Ring> rings = draw(dice, k);
        ASSERT_EQ(outline_fault(rings), "") << k;
        const PrismOutline outline{cut_open(rings), dice.between(-3, 0), dice.between(1, 30)};
        ASSERT_FALSE(outline.corners.empty()) << k;
        const Mesh mesh = prism_mesh(outline);
        ASSERT_EQ(closure_fault(mesh), "") << k;
        double area = shoelace(rings[0]);
        for (std::size_t m = 1; m < rings.size(); ++m) {
            area -= shoelace(rings[m]);
        }
        const double height = outline.top - outline.bottom;
        // Round-off of coordinates of kilometres squared.
        EXPECT_NEAR(solid_properties(mesh).volume, area * height, 1e-7 * height) << k;
        EXPECT_NEAR(signed_area(outline.corners), area, 1e-7) << k;
        with_yards += rings.size() > 1 ? 1 : 0;
        for (int probe = 0; probe < 20; ++probe) {
            const Plan2 p{rings[0][0][0] + dice.between(-15, 15),
                          rings[0][0][1] + dice.between(-15, 15)};
            if (distance(rings, p) < 1e-6) {
                continue; // on the rim the sides may differ by round-off
            }
            bool inside = winding(rings[0], p) != 0;
            for (std::size_t m = 1; m < rings.size(); ++m) {
                inside = inside && winding(rings[m], p) == 0;
            }
            EXPECT_EQ(holds(outline.corners, p), inside) << k;
            const Vec3 middle(p[0], p[1], (outline.top + outline.bottom) / 2);
            EXPECT_EQ(winding(mesh, middle), inside ? 1 : 0) << k;
            EXPECT_EQ(winding(mesh, middle + Vec3(0, 0, height)), 0) << k;
        }
    }
    EXPECT_GT(with_yards, 100);
}

TEST(Outlines, RoofsAreDividedIntoTrianglesThatRunUpwards)
{
    Dice dice(12);
    for (int k = 0; k < 200; ++k) {
        const Ring ring = cut_open(draw(dice, k));
        const auto triangles = ear_triangles(ring);
        EXPECT_EQ(triangles.size() + 2, ring.size()) << k;
        for (const auto& t : triangles) {
            const auto corner = [&](std::size_t m) { return ring[static_cast<std::size_t>(t[m])]; };
            EXPECT_GT(cross(corner(0), corner(1), corner(2)), 0) << k;
        }
    }
}

// Around a sharp corner of the outer ring: several bridges end there.
TEST(Outlines, BridgesMayShareACorner)
{
    Dice dice(14);
    for (int k = 0; k < 200; ++k) {
        std::vector<Ring> rings{{{20, 0}, {-60, 60}, {-60, -60}}};
        double area = shoelace(rings[0]);
        const int yards = 2 + dice.below(4);
        for (int y = 0; y < yards; ++y) {
            const double angle = 0.6 * ((y + 0.5) / yards - 0.5) * 2;
            const double away = dice.between(8, 14);
            rings.push_back(star(dice, {20 - away * std::cos(angle), away * std::sin(angle)}, 0.2,
                                 0.6, 3 + dice.below(3)));
            area -= shoelace(rings.back());
        }
        ASSERT_EQ(outline_fault(rings), "") << k;
        const Mesh mesh = prism_mesh({cut_open(rings), 0, 1});
        ASSERT_EQ(closure_fault(mesh), "") << k;
        EXPECT_NEAR(solid_properties(mesh).volume, area, 1e-9 * area) << k;
    }
}

TEST(Outlines, CoordinatesOfMapsHaveTheSamePrism)
{
    Dice dice(13);
    for (int k = 0; k < 100; ++k) {
        std::vector<Ring> rings = draw(dice, k);
        const double area = signed_area(cut_open(rings));
        for (Ring& ring : rings) {
            for (Plan2& p : ring) {
                p = {p[0] + 378450, p[1] + 4072310};
            }
        }
        ASSERT_EQ(outline_fault(rings), "") << k;
        const Mesh mesh = prism_mesh({cut_open(rings), 0, 1});
        ASSERT_EQ(closure_fault(mesh), "") << k;
        EXPECT_NEAR(solid_properties(mesh).volume, area, 1e-6 * area) << k;
    }
}

TEST(Outlines, FaultsNameTheirCorners)
{
    const Ring square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    const Ring yard{{1, 1}, {3, 1}, {3, 3}, {1, 3}};
    const auto moved = [](Ring ring, double x) {
        for (Plan2& p : ring) {
            p[0] += x;
        }
        return ring;
    };
    EXPECT_EQ(outline_fault({square, yard}), "");
    EXPECT_EQ(outline_fault({}), "it has no corners");
    EXPECT_EQ(outline_fault({{{0, 0}, {1, 0}}}), "it has 2 corners, expected at least 3");
    EXPECT_EQ(outline_fault({{{0, 0}, {4, 0}, {0, 4}, {4, 4}}}),
              "it crosses itself: its edge from corner 2 touches or crosses that from corner 4");
    EXPECT_EQ(outline_fault({{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}}),
              "it crosses itself: its edge from corner 1 touches or crosses that from corner 3");
    EXPECT_EQ(outline_fault({{{0, 0}, {4, 0}, {4, 4}, {4, 1}, {0, 4}}}),
              "it turns back on itself at corner 3");
    EXPECT_EQ(outline_fault({square, moved(yard, 9)}), "inner ring 1 lies outside the outer ring");
    EXPECT_EQ(outline_fault({square, moved(yard, 2)}),
              "inner ring 1 touches or crosses the outer ring");
    EXPECT_EQ(outline_fault({square, yard, moved(yard, 0.5)}),
              "inner rings 1 and 2 touch or overlap");
    EXPECT_EQ(outline_fault({square, yard, {{1.5, 1.5}, {2, 1.5}, {2, 2}}}),
              "inner rings 1 and 2 touch or overlap");
    EXPECT_EQ(outline_fault({square, {{1, 1}, {2, 1}}}),
              "inner ring 1: it has 2 corners, expected at least 3");
    EXPECT_TRUE(prism_mesh({{{0, 0}, {4, 0}, {0, 4}, {4, 4}}, 0, 1}).triangles.empty());
}

} // namespace
} // namespace hyoryu::test_outline
