// SPDX-License-Identifier: MIT
// Meshes of several parts and plates of meshes, against boxes whose insides are known.
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/plan.hpp"
#include "hyoryu/scene/triangle_tree.hpp"
#include "scene/surfaces/mesh_parts.hpp"

#include "dice.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace hyoryu::test_mesh_parts {
namespace {

struct Brick {
    Vec3 half, centre;
    Quat turn = Quat::Identity();

    // In half edges: at most 1 inside.
    double place(const Vec3& p) const
    {
        const Vec3 own = turn.conjugate() * (p - centre);
        return own.cwiseQuotient(half).cwiseAbs().maxCoeff();
    }
};

enum class Faces { outwards, inwards };

void add(const Brick& brick, Faces faces, MeshShape& mesh)
{
    const int first = static_cast<int>(mesh.corners.size());
    for (int k = 0; k < 8; ++k) {
        const Vec3 sign((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
        mesh.corners.emplace_back(brick.centre + brick.turn * sign.cwiseProduct(brick.half));
    }
    constexpr int sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                 {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& s : sides) {
        for (const auto& [b, c] : {std::pair(s[1], s[2]), std::pair(s[2], s[3])}) {
            mesh.triangles.push_back(faces == Faces::outwards
                                         ? std::array{first + s[0], first + b, first + c}
                                         : std::array{first + s[0], first + c, first + b});
        }
    }
}

Brick drawn(Dice& dice, double room)
{
    const auto vector = [&](double low, double high) {
        const double x = dice.between(low, high);
        const double y = dice.between(low, high);
        return Vec3(x, y, dice.between(low, high));
    };
    const Vec3 axis = vector(-1, 1);
    return {vector(0.1, 0.6), vector(-room, room),
            Quat(dice.between(-1, 1), axis.x(), axis.y(), axis.z()).normalized()};
}

// The share of the volume that both bricks hold, both enlarged, by places at random in the first.
double common(const Brick& a, const Brick& b, double enlarged, Dice& dice)
{
    int both = 0;
    constexpr int places = 20000;
    for (int n = 0; n < places; ++n) {
        const double x = dice.between(-enlarged, enlarged);
        const double y = dice.between(-enlarged, enlarged);
        const Vec3 own(x, y, dice.between(-enlarged, enlarged));
        both += b.place(a.centre + a.turn * own.cwiseProduct(a.half)) < enlarged ? 1 : 0;
    }
    return static_cast<double>(both) / places;
}

TEST(MeshParts, OverlapsAreFoundAndPartsThatAreApartAreNone)
{
    Dice dice(11);
    int overlaps = 0;
    int apart = 0;
    for (int n = 0; n < 200; ++n) {
        const Brick a = drawn(dice, 0.7);
        const Brick b = drawn(dice, 0.7);
        MeshShape mesh;
        add(a, Faces::outwards, mesh);
        add(b, Faces::outwards, mesh);
        const PartFaults faults = part_faults(mesh);
        EXPECT_FALSE(faults.inside_out);
        // In between two bricks touch, or share a corner that sampling may miss.
        if (common(a, b, 1.02, dice) == 0) {
            EXPECT_FALSE(faults.overlap) << "pair " << n;
            ++apart;
        } else if (common(a, b, 1, dice) > 0.02) {
            ASSERT_TRUE(faults.overlap) << "pair " << n;
            EXPECT_LT(std::max(a.place(*faults.overlap), b.place(*faults.overlap)), 1.001)
                << "the place is in both";
            ++overlaps;
        }
    }
    EXPECT_GT(overlaps, 40);
    EXPECT_GT(apart, 40);
}

TEST(MeshParts, PiecesAreJoinedByEdges)
{
    Dice dice(14);
    MeshShape mesh;
    for (int bricks = 1; bricks < 6; ++bricks) {
        add(drawn(dice, 2), Faces::outwards, mesh);
        const TriangleTree tree = triangle_tree(mesh.corners, mesh.triangles);
        std::vector<int> pieces = pieces_of(tree);
        std::ranges::sort(pieces);
        EXPECT_EQ(std::ranges::unique(pieces).begin() - pieces.begin(), bricks);
        EXPECT_EQ(tree.is_one_piece, bricks == 1);
    }
}

// A tower on the corner of its slab: a reader of STL makes one corner of the two.
TEST(MeshParts, BricksThatShareACornerAreTwoParts)
{
    Dice dice(13);
    for (int n = 0; n < 40; ++n) {
        const Brick a = drawn(dice, 0.7);
        Brick b = drawn(dice, 0.7);
        b.turn = a.turn; // and the same lowest corner
        b.centre = a.centre + a.turn * (b.half - a.half);
        MeshShape mesh;
        add(a, Faces::outwards, mesh);
        add(b, Faces::outwards, mesh);
        for (auto& triangle : mesh.triangles) {
            std::ranges::replace(triangle, 8, 0);
        }
        mesh.corners.erase(mesh.corners.begin() + 8);
        for (auto& triangle : mesh.triangles) {
            for (int& corner : triangle) {
                corner -= corner > 8 ? 1 : 0;
            }
        }
        EXPECT_TRUE(part_faults(mesh).overlap) << n;
        const TriangleTree tree = triangle_tree(mesh.corners, mesh.triangles);
        EXPECT_FALSE(tree.is_one_piece);
        for (int k = 0; k < 50; ++k) {
            const double x = dice.between(-1.5, 1.5);
            const double y = dice.between(-1.5, 1.5);
            const Vec3 p = a.centre + Vec3(x, y, dice.between(-1.5, 1.5));
            const double place = std::min(a.place(p), b.place(p));
            if (std::abs(place - 1) > 0.05) { // the winding number is off by some hundredths
                EXPECT_EQ(nearest_place(tree, p, infinity).distance < 0, place < 1) << n;
            }
        }
    }
}

TEST(MeshParts, ACavityIsNoFaultAndAPartThatFacesInwardsIsOne)
{
    Dice dice(12);
    for (int n = 0; n < 40; ++n) {
        const Brick outer = drawn(dice, 3);
        Brick inner = outer;
        inner.half *= dice.between(0.2, 0.95);
        Brick beside = outer;
        beside.centre += 5 * Vec3::UnitX();
        const auto faults_of = [](const Brick& a, const Brick& b, Faces faces) {
            MeshShape mesh;
            add(a, Faces::outwards, mesh);
            add(b, faces, mesh);
            return part_faults(mesh);
        };
        const PartFaults cavity = faults_of(outer, inner, Faces::inwards);
        EXPECT_FALSE(cavity.inside_out || cavity.overlap);
        EXPECT_TRUE(faults_of(outer, inner, Faces::outwards).overlap);
        EXPECT_TRUE(faults_of(outer, beside, Faces::inwards).inside_out);
        const PartFaults two = faults_of(outer, beside, Faces::outwards);
        EXPECT_FALSE(two.inside_out || two.overlap);
    }
}

// A wall between water and a body: as a box, or as a mesh, turned.
Scene with_wall(const Brick& wall, bool as_mesh, double dp, bool body_moves)
{
    Scene scene = parse_case(
        fmt::format("[time]\nend = 1.0\n[particles]\nspacing = {0}\n[fluid]\n[[fluid.block]]\n"
                    "shape = \"box\"\nmin = [-4, -4, 0]\nmax = [-3.5, -3.5, 0.5]\n[[wall]]\n"
                    "shape = \"basin\"\nmin = [-4, -4, 0]\nmax = [4, 4, 1]\nopen = [\"+z\"]\n"
                    "[[wall]]\nname = \"sheet\"\nshape = \"box\"\nsize = [{1}, {2}, {3}]\n"
                    "position = [0, 0, 0.5]\n[[body]]\nname = \"b\"\nshape = \"box\"\n"
                    "size = [0.5, 0.5, 0.5]\ndensity = 500\nposition = [3, 3, 0.3]\n{4}\n",
                    dp, 2 * wall.half.x(), 2 * wall.half.y(), 2 * wall.half.z(),
                    body_moves ? "" : "fixed = true"),
        "case.toml");
    auto& solid = std::get<SolidWall>(scene.walls[1].geometry);
    solid.rotation = wall.turn;
    if (as_mesh) {
        MeshShape mesh;
        add({wall.half, {0, 0, 0}}, Faces::outwards, mesh);
        solid.shape = mesh;
    }
    return scene;
}

std::size_t warnings(const Scene& scene, const std::string& words)
{
    const Plan plan = make_plan(scene, fill(scene));
    return static_cast<std::size_t>(
        std::ranges::count_if(plan.warnings, [&](const Diagnostic& warning) {
            return warning.what.find(words) != std::string::npos;
        }));
}

// Particles of the fluid and of a body that touch the two sides of a wall are its thickness and
// nearly a spacing apart; the kernel reaches 3 spacings.
TEST(PlanWarnings, OfWallsThroughWhichWaterPushesBodies)
{
    Dice dice(13);
    int warned = 0;
    for (int n = 0; n < 24; ++n) {
        const double dp = n % 2 == 0 ? 0.15 : 0.1;
        const double thick = dice.between(0.4, 3.5) * dp;
        const Brick sheet{{thick / 2, dice.between(0.4, 0.9), dice.between(0.4, 0.9)},
                          {0, 0, 0},
                          drawn(dice, 0).turn};
        for (const bool as_mesh : {false, true}) {
            const Scene scene = with_wall(sheet, as_mesh, dp, true);
            const std::size_t thinner = thick < dp ? 1 : 0;
            const std::size_t pushes = thick >= dp && thick < 2.1 * dp ? 1 : 0;
            EXPECT_EQ(warnings(scene, "two sides is not well separated"), thinner);
            EXPECT_EQ(warnings(scene, "pushes bodies that touch its other side"), pushes);
            warned += static_cast<int>(pushes);
            const Scene still = with_wall(sheet, as_mesh, dp, false);
            EXPECT_EQ(warnings(still, "pushes bodies"), 0U) << "no body moves";
        }
    }
    EXPECT_GT(warned, 8);
}

TEST(PlanWarnings, OfThinWallsLeaveColumnsOut)
{
    Dice dice(14);
    for (int n = 0; n < 12; ++n) {
        const double dp = 0.1;
        const double thick = dice.between(1, 2) * dp;
        const Brick column{
            {thick / 2, dice.between(0.5, 0.9) * thick, 0.5}, {0, 0, 0}, drawn(dice, 0).turn};
        for (const bool as_mesh : {false, true}) {
            EXPECT_EQ(warnings(with_wall(column, as_mesh, dp, true), "pushes bodies"), 0U);
        }
    }
}

} // namespace
} // namespace hyoryu::test_mesh_parts
