// SPDX-License-Identifier: MIT
// Solids that fall on the ridge of a sharp wedge made of triangles. The middle of such a solid is
// mostly behind the plane of one of the two triangles that meet at the ridge. What they overlap is
// judged by support functions alone. HYORYU_MEETINGS=500 runs that many, HYORYU_SEED is the first.
#include "dice.hpp"
#include "scenes.hpp"
#include "surfaces.hpp"
#include "witness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hyoryu::test_ridges {
namespace {

using namespace test;

/// A prism with its ridge along y, at z = 0, and the angle between its sides [degrees].
Polytope wedge(double degrees, double half_length, double depth)
{
    const double half = depth * std::tan(degrees * 3.14159265358979323846 / 360);
    std::vector<Vec3> corners;
    for (const double y : {-half_length, half_length}) {
        corners.emplace_back(0, y, 0);
        corners.emplace_back(-half, y, -depth);
        corners.emplace_back(half, y, -depth);
    }
    return convex_hull(corners);
}

ContactShape faller(int seed, Dice& dice)
{
    switch (seed % 5) {
    case 0:
        return box_polytope({dice.between(0.05, 0.3), dice.between(0.05, 0.3), 0.15}, 3);
    case 1:
        return Rod{dice.between(0.03, 0.1), dice.between(0.05, 0.3)};
    case 2:
        return Ball{dice.between(0.04, 0.12)};
    case 3:
        return random_hull(dice, 0.12);
    default: {
        Polytope knife = wedge(dice.between(10, 60), 0.1, 0.15);
        for (Vec3& corner : knife.corners) {
            corner.z() += 0.1; // two thirds of its depth: its middle
        }
        return convex_hull(knife.corners);
    }
    }
}

struct Fall {
    Rigid rigid;
    Convex ridge;
    std::vector<Convex> solids() const
    {
        const Body& body = rigid.bodies[0];
        return pieces(body.shape, body.position, body.orientation);
    }
};

/// One solid just above the ridge.
Fall on_ridge(int seed)
{
    Dice dice(seed);
    const double friction = dice.between(0, 0.6);
    Fall fall{scene(friction, dice.between(0, 0.8)), {}};
    const Polytope prism = wedge(dice.between(10, 60), 0.5, 0.8);
    fall.ridge.points = prism.corners;
    fall.rigid.boundaries.push_back({"ridge", surface_of(prism, Vec3::Zero())});
    const ContactShape shape = faller(seed, dice);
    Body body = body_of(shape, dice.between(200, 900), {0, 0, 0});
    body.orientation = dice.turn();
    const double reach = bounding_radius(body, 3);
    body.position = {dice.between(-0.7, 0.7) * reach, dice.between(-0.4, 0.4), 0};
    const std::vector<Convex> solid = pieces(body.shape, body.position, body.orientation);
    body.position.z() = dice.between(0.001, 0.02) - solid[0].farthest(-Vec3::UnitZ()).z();
    body.velocity = dice.within(1) - Vec3(0, 0, dice.between(0, 2));
    body.angular_momentum = angular_momentum(body, dice.within(5));
    fall.rigid.bodies.push_back(body);
    return fall;
}

TEST(Ridges, CarryWhatFallsOnThemAndLetNothingIn)
{
    struct Run {
        double dt, overlap; // the bounds of random scenes
    };
    const int first = number_from("HYORYU_SEED", 1);
    int runs = 0;
    int impacts = 0;
    for (int seed = first; seed < first + number_from("HYORYU_MEETINGS", 60); ++seed) {
        for (const Run& at : {Run{1e-3, 1e-5}, Run{5e-3, 1e-4}}) {
            Fall fall = on_ridge(seed);
            double deepest = 0;
            Vec3 hint = Vec3::Zero();
            const auto log = run(fall.rigid, at.dt, static_cast<int>(0.25 / at.dt), [&](double) {
                deepest = std::max(deepest, depth(fall.solids()[0], fall.ridge, hint));
            });
            ++runs;
            impacts += log.empty() ? 0 : 1;
            EXPECT_LT(deepest, at.overlap) << "HYORYU_SEED=" << seed << " dt " << at.dt;
        }
    }
    EXPECT_GT(2 * impacts, runs); // some pass beside the ridge
}

} // namespace
} // namespace hyoryu::test_ridges
