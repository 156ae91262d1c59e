// SPDX-License-Identifier: MIT
// Shapes to particles, and the plan.
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/plan.hpp"
#include "hyoryu/scene/rigid_scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <numbers>

namespace hyoryu::test_fill {
namespace {

constexpr const char* tank = R"(
[time]
end = 1.0
[particles]
spacing = 0.1
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [1.0, 1.0, 0.5]
[[wall]]
name = "basin"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [1.0, 1.0, 0.8]
open = ["+z"]
)";

TEST(Fill, FluidMeetsTheWallAtHalfASpacing)
{
    const Filling filling = fill(parse_case(tank, "t.toml"));
    ASSERT_EQ(filling.fluid.size(), 500u);
    for (const Vec3& p : filling.fluid) {
        EXPECT_GE(p.minCoeff(), 0.05 - 1e-12);
        EXPECT_LE(p.z(), 0.45 + 1e-12);
    }
    double nearest = infinity;
    for (const Vec3& p : filling.wall) {
        EXPECT_FALSE((p.array() > 0).all() && p.x() < 1 && p.y() < 1 && p.z() < 0.8);
        nearest = std::min(nearest, (p - filling.fluid.front()).norm());
    }
    EXPECT_NEAR(nearest, 0.1, 1e-12);
    // 3 layers of floor, 3 layers of four sides: a 16 x 16 ring over 8 + a full 16 x 16 below.
    EXPECT_EQ(filling.wall.size(), 16u * 16 * 3 + (16u * 16 - 100) * 8);
}

TEST(Fill, DepthIsThatOfTheSurfaceAbove)
{
    const Filling filling = fill(parse_case(tank, "t.toml"));
    for (std::size_t k = 0; k < filling.fluid.size(); ++k) {
        EXPECT_NEAR(filling.fluid_depth[k], 0.5 - filling.fluid[k].z(), 1e-12);
    }
}

// 12 and a half cells high: 13 of them wherever the block stands, although the width of 0.4 m is
// not the same number everywhere.
TEST(Fill, HalfACellIsRoundedTheSameWayAtAnyPlace)
{
    for (int k = 0; k < 40; ++k) {
        const double left = 0.1 * k;
        const std::string text = fmt::format(
            "dimensions = 2\n[time]\nend = 1.0\n[particles]\nspacing = 0.04\n[fluid]\n"
            "[[fluid.block]]\nshape = \"box\"\nmin = [{}, 0, 0]\nmax = [{}, 0, 0.5]\n"
            "[[wall]]\nname = \"basin\"\nshape = \"basin\"\nmin = [0, 0, 0]\nmax = [5, 0, 1]\n"
            "open = [\"+z\"]\n",
            left, left + 0.4);
        EXPECT_EQ(fill(parse_case(text, "t.toml")).fluid.size(), 130u) << left;
    }
}

TEST(Fill, ABodyTakesOutExactlyItsVolume)
{
    const std::string body = R"(
[[body]]
shape = "box"
size = [0.4, 0.3, 0.3]
density = 500.0
position = [0.5, 0.5, 0.3]
rotation_deg = { axis = [0, 0, 1], angle = 30.0 }
)";
    const Filling filling = fill(parse_case(tank + body, "t.toml"));
    // 0.036 m3 in water 0.5 m deep: 36 particles of 0.001 m3, to the accuracy of the sub-cells.
    EXPECT_NEAR(500.0 - static_cast<double>(filling.fluid.size()), 36, 1);
}

TEST(Fill, CoincidentWallsShareTheirParticles)
{
    const std::string floor = R"(
[[wall]]
shape = "plane"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
)";
    const Filling filling = fill(parse_case(tank + floor, "t.toml"));
    for (std::size_t a = 0; a < filling.wall.size(); a += 7) {
        for (std::size_t b = 0; b < filling.wall.size(); ++b) {
            if (a != b) {
                ASSERT_GT((filling.wall[a] - filling.wall[b]).norm(), 0.05);
            }
        }
    }
}

TEST(Fill, TheDomainHoldsWallsWhereverTheyMove)
{
    const Scene scene = parse_case(R"(
[time]
end = 2.0
[particles]
spacing = 0.1
[fluid]
[[fluid.block]]
shape = "box"
min = [0, 0, 0]
max = [1, 1, 1]
[[wall]]
shape = "basin"
min = [0, 0, 0]
max = [1, 1, 2]
[wall.motion]
times = [0, 1, 3]
places = [[0, 0, 0], [-0.5, 0, 0], [8, 0, 0]]
[[wall]]
shape = "box"
min = [0.4, 0.4, 0.8]
max = [0.6, 0.6, 0.9]
[wall.motion]
velocity = [0, 1, 0]
)",
                                   "test.toml");
    const Bounds domain = domain_of(scene);
    EXPECT_EQ(domain.min.x(), -0.5);
    // Halfway to 8 m when the run ends, and not there yet.
    EXPECT_GT(domain.max.x(), 2.0);
    EXPECT_LT(domain.max.x(), 8.0);
    EXPECT_DOUBLE_EQ(domain.max.y(), 2.6);
}

TEST(Aggregate, LayersConformToTheSurface)
{
    const double R = 0.5;
    const double dp = 0.1;
    const Aggregate ball = aggregate(SphereShape{R}, dp, 3);
    double farthest = 0;
    Vec3 centre = Vec3::Zero();
    for (const Vec3& p : ball.points) {
        farthest = std::max(farthest, p.norm());
        centre += p;
    }
    EXPECT_NEAR(farthest, R - dp / 2, 1e-12);
    EXPECT_NEAR(ball.particle_volume * static_cast<double>(ball.points.size()),
                4.0 / 3.0 * std::numbers::pi * R * R * R, 1e-12);
    // One particle stands for about one lattice cell.
    EXPECT_NEAR(ball.particle_volume / (dp * dp * dp), 1, 0.1);
    EXPECT_LT(centre.norm() / static_cast<double>(ball.points.size()), 0.1 * dp);

    const Aggregate box = aggregate(BoxShape{{0.3, 0.2, 0.1}}, dp, 3);
    EXPECT_EQ(box.points.size(), 6u);
    EXPECT_EQ(box.surface_points, 6);
}

TEST(Plan, NamesWhatRunsAndWhatDoesNot)
{
    const Scene scene = parse_case(tank, "t.toml");
    const Plan plan = make_plan(scene, fill(scene));
    for (const char* effect :
         {"gravity", "pressure", "artificial_viscosity", "density_diffusion"}) {
        EXPECT_TRUE(plan.runs(effect)) << effect;
    }
    for (const char* effect :
         {"contact", "body_load", "rigid_motion", "laminar_viscosity", "shifting"}) {
        EXPECT_FALSE(plan.runs(effect)) << effect;
    }
    // c0 = 10 x 2 sqrt(g H)
    EXPECT_NEAR(plan.fluid->eos.c0, 20 * std::sqrt(9.81 * 0.5), 0.01 * plan.fluid->eos.c0);
}

TEST(Plan, AbsurdSizesAreRefusedBeforeAnythingIsMade)
{
    const Scene scene = parse_case(tank, "t.toml", {"particles.spacing=1e-6"});
    EXPECT_THROW(fill(scene), CaseError);
}

TEST(RigidScene, AMeshMeetsOthersByItsHull)
{
    std::vector<Vec3> points;
    for (int k = 0; k < 8; ++k) {
        points.emplace_back((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 2 : -2, (k & 4) != 0 ? 3 : -3);
    }
    points.emplace_back(0.1, 0.2, 0.3); // inside
    const Polytope hull = convex_hull(points);
    EXPECT_EQ(hull.corners.size(), 8u);
    ASSERT_EQ(hull.faces.size(), 6u);
    for (const auto& face : hull.faces) {
        EXPECT_EQ(face.size(), 4u);
        const Vec3& a = hull.corners[static_cast<std::size_t>(face[0])];
        const Vec3& b = hull.corners[static_cast<std::size_t>(face[1])];
        const Vec3& c = hull.corners[static_cast<std::size_t>(face[2])];
        EXPECT_GT((b - a).cross(c - b).dot(a), 0); // counter-clockwise from outside
    }
}

TEST(Fill, FieldsOfVelocityAndPressureAreThoseOfThePlace)
{
    const std::string text = R"(
dimensions = 2
[time]
end = 1.0
[particles]
spacing = 0.1
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [1.0, 0.0, 1.0]
velocity_field = ["-2*x", "7", "2*z + x^2"]
pressure_field = "100*x*z"
)";
    const Scene scene = parse_case(text, "test.toml");
    const Filling filling = fill(scene);
    ASSERT_EQ(filling.fluid.size(), 100u);
    for (std::size_t k = 0; k < filling.fluid.size(); ++k) {
        const Vec3& x = filling.fluid[k];
        EXPECT_EQ(filling.fluid_velocity[k], Vec3(-2 * x.x(), 0, 2 * x.z() + x.x() * x.x()));
        EXPECT_EQ(filling.fluid_pressure[k], 100 * x.x() * x.z());
    }
    const Filling again = fill(parse_case(to_toml(scene), "resolved.toml"));
    EXPECT_EQ(again.fluid_velocity, filling.fluid_velocity);
    EXPECT_EQ(again.fluid_pressure, filling.fluid_pressure);
}

// 13.5 spacings wide: the cells at both sides are cut to a quarter.
TEST(Fill, ABodyThatCutsCellsDisplacesTheSameOnBothSides)
{
    const Filling filling = fill(parse_case(R"(
dimensions = 2
[time]
end = 1.0
[particles]
spacing = 0.02
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.9, 0.0, 0.4]
[[body]]
shape = "box"
size = [0.27, 0.0, 0.2]
density = 500.0
position = [0.45, 0.0, 0.4]
)",
                                            "test.toml"));
    Index left = 0;
    Index right = 0;
    for (const Vec3& p : filling.fluid) {
        left += p.x() < 0.44 ? 1 : 0;
        right += p.x() > 0.46 ? 1 : 0;
    }
    EXPECT_LE(std::abs(left - right), 1);
    EXPECT_NEAR(static_cast<double>(filling.fluid.size()), 45 * 20 - 13.5 * 5, 0.51);
}

// Its bottom cuts cells by four fifths, of which one in five stays, and its top by a fifth.
TEST(Fill, WhatStaysOfCutCellsStandsOutsideTheBody)
{
    const Filling filling = fill(parse_case(R"(
dimensions = 2
[time]
end = 1.0
[particles]
spacing = 0.02
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.4, 0.0, 0.4]
[[body]]
shape = "box"
size = [0.2, 0.0, 0.2]
density = 500.0
position = [0.2, 0.0, 0.204]
)",
                                            "test.toml"));
    for (std::size_t k = 0; k < filling.fluid.size(); ++k) {
        const Vec3& p = filling.fluid[k];
        EXPECT_GT(std::max(std::abs(p.x() - 0.2), std::abs(p.z() - 0.204)), 0.1) << p.transpose();
        EXPECT_NEAR(filling.fluid_depth[k], 0.4 - p.z(), 1e-12);
    }
    EXPECT_EQ(filling.fluid.size(), 20u * 20 - 100);
}

// What stays of cut cells could not give way at a wall: it was pressed into the joint of wall and
// body. Of the 8 x 9.8 cells that the body displaces one in five of those under it stays.
TEST(Fill, WhatStaysOfCutCellsStandsOffWallsAndBody)
{
    for (const double x : {0.08, 0.32}) {
        const Filling filling = fill(parse_case(fmt::format(R"(
dimensions = 2
[time]
end = 1.0
[particles]
spacing = 0.02
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.4, 0.0, 0.4]
[[wall]]
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [0.4, 0.0, 0.8]
open = ["+z"]
[[body]]
shape = "box"
size = [0.16, 0.0, 0.2]
density = 500.0
position = [{}, 0.0, 0.304]
)",
                                                            x),
                                                "test.toml"));
        EXPECT_NEAR(static_cast<double>(filling.fluid.size()), 20 * 20 - 8 * 9.8, 1);
        for (std::size_t k = 0; k < filling.fluid.size(); ++k) {
            const Vec3& p = filling.fluid[k];
            EXPECT_GT(std::min({p.x(), 0.4 - p.x(), p.z()}), 0.45 * 0.02) << p.transpose();
            EXPECT_GT(std::max(std::abs(p.x() - x) - 0.08, 0.204 - p.z()), 0.45 * 0.02)
                << p.transpose();
            EXPECT_NEAR(filling.fluid_depth[k], 0.4 - p.z(), 1e-12);
        }
    }
}

// E5: a formula that gives no number somewhere in the block is told before the run, with the place;
// one that does so only outside of it is not.
TEST(Fill, FieldsMustGiveANumberWhereThereIsFluid)
{
    const std::vector<std::pair<std::string, std::string>> bad = {
        {"velocity_field = [\"1/0\", \"0\", \"0\"]", "velocity_field"},
        {"velocity_field = [\"0\", \"0\", \"sqrt(-1 - x)\"]", "velocity_field"},
        {"velocity_field = [\"0\", \"1/(x - 0.35)\", \"0\"]", "velocity_field"},
        {"velocity_field = [\"exp(900*x)\", \"0\", \"0\"]", "velocity_field"},
        {"velocity_field = [\"1e7\", \"0\", \"0\"]", "velocity_field"},
        {"pressure_field = \"1/0\"", "pressure_field"},
        {"pressure_field = \"ln(-z)\"", "pressure_field"}};
    const std::string block = "max = [1.0, 1.0, 0.5]\n";
    const auto with = [&](const std::string& field) {
        std::string text = tank;
        return parse_case(text.insert(text.find(block) + block.size(), field + "\n"), "t.toml");
    };
    for (const auto& [field, key] : bad) {
        SCOPED_TRACE(field);
        try {
            fill(with(field));
            ADD_FAILURE() << "nothing was told";
        } catch (const CaseError& error) {
            const Diagnostic& d = error.diagnostics().front();
            EXPECT_EQ(d.key, "fluid.block[0]." + key);
            EXPECT_NE(d.what.find(" at ("), std::string::npos) << d.what;
            EXPECT_EQ(d.line, 7);
        }
    }
    EXPECT_NO_THROW(fill(with("velocity_field = [\"1/(x - 2)\", \"0\", \"sqrt(x)\"]")));
}

// E8: 100,000 bodies in a lattice, and all along one line: pairs are found without looking at all.
TEST(Plan, ManyBodiesAreCheckedQuickly)
{
    for (const char* count : {"[46, 46, 47]", "[100000, 1, 1]", "[1, 316, 316]"}) {
        const Scene scene = parse_case(
            std::string(
                "[time]\nend = 1.0\n[particles]\nspacing = 0.1\n[[body]]\nname = \"b\"\n"
                "shape = \"sphere\"\nradius = 0.05\ndensity = 500\n"
                "position = [0, 0, 0.05]\n[body.copies]\npitch = [0.1, 0.1, 0.1]\ncount = ") +
                count + "\n",
            "t.toml");
        const auto start = std::chrono::steady_clock::now();
        make_plan(scene, fill(scene));
        const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
        EXPECT_LT(wall.count(), 20) << count; // 100 s when all pairs were looked at; now 2
    }
}

// E8: 100,000 boxes beside water, one heap of which each may cut cells together with its
// neighbours.
TEST(Fill, E8ManyBodiesBesideWaterAreGroupedQuickly)
{
    const Scene scene =
        parse_case("[time]\nend = 1.0\n[particles]\nspacing = 0.25\n[fluid]\n[[fluid.block]]\n"
                   "shape = \"box\"\nmin = [0.0, 0.0, 0.0]\nmax = [5.0, 10.0, 2.0]\n[[body]]\n"
                   "name = \"b\"\nshape = \"sphere\"\nradius = 0.15\ndensity = 500\n"
                   "spacing = 0.15\nposition = [6, 0.5, 0.2]\n[body.copies]\n"
                   "pitch = [0.45, 0.45, 0.45]\ncount = [46, 46, 47]\n",
                   "t.toml");
    const auto start = std::clock();
    fill(scene);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    EXPECT_LT(seconds, 10); // 16 and more where every body asked all before it; now 1
}

} // namespace
} // namespace hyoryu::test_fill
