// SPDX-License-Identifier: MIT
// Solids deep in an edge or corner of a basin that looks inwards: each side covers the contact with
// the other there. Where the deepest point lies is chosen, so that the overlap is known.
#include "dice.hpp"
#include "scenes.hpp"
#include "surfaces.hpp"
#include "witness.hpp"

#include "rigid/collision/narrow_phase.hpp"

#include <gtest/gtest.h>

namespace hyoryu::test_inward_corners {
namespace {

using namespace test;

// A pyramid with its tip at the origin, about the x axis, so narrow that no point lies farther
// towards any of three walls that its tip points between.
Polytope narrow_pyramid(Dice& dice)
{
    std::vector<Vec3> points{Vec3::Zero()};
    const double length = dice.between(0.1, 0.3);
    const double width = length * std::tan(dice.between(0.08, 0.25));
    for (int k = 0; k < 4; ++k) {
        const double angle = 1.57 * (k + dice.between(-0.3, 0.3));
        points.emplace_back(-length, width * std::cos(angle), width * std::sin(angle));
    }
    return convex_hull(points);
}

/// A basin open at +z with its deepest corner at the origin: of boxes, or of triangles.
Boundary basin_of(bool mesh, const Vec3& size, double thickness)
{
    if (!mesh) {
        Basin basin{{0, 0, 0}, size, {}, thickness};
        basin.open[5] = true;
        return {"basin", basin};
    }
    Polytope inside = box_polytope(size, 3);
    for (Vec3& corner : inside.corners) {
        corner += 0.5 * size;
    }
    MeshSurface surface = surface_of(inside, Vec3::Zero());
    std::erase_if(surface.triangles, [&](std::array<int, 3>& t) {
        const auto at = [&](std::size_t k) {
            return surface.corners[static_cast<std::size_t>(t[k])];
        };
        const Vec3 out = (at(1) - at(0)).cross(at(2) - at(0));
        if (out.dot(at(0) - 0.5 * size) > 0) {
            std::swap(t[1], t[2]); // its front looks inwards
        }
        return std::min({at(0).z(), at(1).z(), at(2).z()}) > 0.5 * size.z();
    });
    return {"basin", surface};
}

/// By how much the contact search says that the body is in the basin [m].
double told_overlap(const Body& body, const Boundary& basin)
{
    Geometry geometry;
    geometry.solids.push_back(solid_of(body.shape, 3));
    geometry.walls.push_back(wall_of(basin, 3));
    const std::vector<SolidPose> poses{pose_of(body.position, body.orientation)};
    std::vector<Candidate> found;
    find_candidates({0, -1}, {geometry, poses}, clearly_apart(geometry), found);
    double deepest = 0;
    for (const Candidate& candidate : found) {
        deepest = std::max(deepest, -candidate.touch.gap);
    }
    return deepest;
}

// The tip of a pyramid, or the point of a rim of a cylinder that is farthest towards the walls,
// goes behind two or three of them: it is in them by the least of its depths.
void expect_shown(int seed, bool mesh)
{
    Dice dice(seed);
    const Vec3 size{dice.between(0.8, 1.5), dice.between(0.8, 1.5), dice.between(0.5, 1)};
    // What is in triangles by less than 1e-5 m along their best axis may be left to the next step.
    const double deep = std::pow(10.0, dice.between(-3.7, -2.5));
    Vec3 depth(0, 0, 0);
    Vec3 towards(0, 0, 0);
    const bool corner = seed % 2 == 0; // of three sides
    for (int k = corner ? 0 : 1; k < 3; ++k) {
        depth[k] = deep * dice.between(0.2, 1);
        towards[k] = -dice.between(0.5, 1);
    }
    const double least = corner ? depth.minCoeff() : std::min(depth.y(), depth.z());
    const bool round = !mesh && seed / 2 % 2 == 0;
    ContactShape shape = narrow_pyramid(dice);
    if (round) {
        shape = Rod{dice.between(0.02, 0.08), dice.between(0.1, 0.3)};
    }
    Body body = body_of(shape, 500, {0, 0, 0});
    body.orientation = round ? dice.turn()
                             : Quat::FromTwoVectors(Vec3::UnitX(), towards) *
                                   turn_about(Vec3::UnitX(), dice.between(0, 360));
    const Vec3 point =
        pieces(shape, Vec3::Zero(), body.orientation).front().farthest(towards.normalized());
    body.position = -point - depth;
    body.position.x() = corner ? body.position.x() : 0.5 * size.x();
    const double told = told_overlap(body, basin_of(mesh, size, dice.between(0.02, 0.2)));
    // A narrow tip leaves a triangle sideways by a part of its depth.
    EXPECT_GT(told, 0.1 * least) << "HYORYU_SEED=" << seed << ", depth " << depth.transpose();
}

void expect_all_shown(bool mesh)
{
    const int first = number_from("HYORYU_SEED", 1);
    for (int seed = first; seed < first + number_from("HYORYU_MEETINGS", 400); ++seed) {
        expect_shown(seed, mesh);
    }
}

TEST(InwardCorners, BasinsShowWhatIsDeepInTwoSides)
{
    expect_all_shown(false);
}

TEST(InwardCorners, MeshesShowWhatIsDeepInTwoSides)
{
    expect_all_shown(true);
}

} // namespace
} // namespace hyoryu::test_inward_corners
