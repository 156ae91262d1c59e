// SPDX-License-Identifier: MIT
// What is left alone comes to rest to round-off, however many ways there are to share its load.
#include "dice.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hyoryu::test_rest {
namespace {

using namespace test;

// Boxes on one another, each turned about the vertical and set off at random: the contacts of every
// joint are the corners of a polygon, up to eight, of which three would do.
Rigid turned_stack(Dice& dice, int boxes)
{
    constexpr double a = 0.2;
    Rigid rigid = on_floor(0.2, dice.between(0.3, 0.8));
    for (int k = 0; k < boxes; ++k) {
        Body body = box({a, a, a / 2}, dice.between(300, 900), {0, 0, (k + 0.5) * a / 2});
        body.position += 0.1 * a * Vec3{dice.between(-1, 1), dice.between(-1, 1), 0};
        body.orientation = Eigen::AngleAxisd(dice.between(-1, 1), Vec3::UnitZ());
        rigid.bodies.push_back(body);
    }
    return rigid;
}

// Layers of bricks set off against one another, each by a part of its length and with a small turn.
// The end bricks of each second layer are held by those above them alone.
Rigid masonry(Dice& dice, int layers)
{
    Rigid rigid = on_floor(0.2, dice.between(0.4, 0.8));
    const Vec3 brick{0.24, 0.12, 0.06};
    for (int layer = 0; layer < layers; ++layer) {
        for (int k = 0; k < 3; ++k) {
            const double x = 0.26 * (k + dice.between(-0.03, 0.03)) + 0.13 * (layer % 2);
            Body body = box(brick, 1800, {x, 0.01 * dice.between(-1, 1), (layer + 0.5) * brick[2]});
            body.orientation = Eigen::AngleAxisd(dice.between(-0.04, 0.04), Vec3::UnitZ());
            rigid.bodies.push_back(body);
        }
    }
    return rigid;
}

// The largest speed within a tenth of a second, after two seconds to come to rest.
double speed_at_rest(Rigid& rigid, double dt)
{
    run(rigid, dt, static_cast<int>(2 / dt));
    double most = 0;
    run(rigid, dt, static_cast<int>(0.1 / dt), [&](double) {
        for (const Body& body : rigid.bodies) {
            most = std::max({most, body.velocity.norm(), 0.1 * angular_velocity(body).norm()});
        }
    });
    return most;
}

// A solution may leave 1e-6 of g dt, 1e-8 m/s: what does not die down stays at that.
constexpr double rest = 1e-11; // [m/s]

TEST(Rest, OfStacksTurnedAtRandomIsRoundOff)
{
    for (int seed = 1; seed <= number_from("HYORYU_STACKS", 6); ++seed) {
        SCOPED_TRACE(seed);
        for (const double dt : {1e-3, 5e-3}) {
            Dice dice(seed);
            Rigid rigid = turned_stack(dice, 3 + seed);
            EXPECT_LT(speed_at_rest(rigid, dt), rest) << "steps of " << dt << " s";
        }
    }
}

TEST(Rest, OfMasonryIsRoundOff)
{
    for (int seed = 1; seed <= number_from("HYORYU_STACKS", 4); ++seed) {
        SCOPED_TRACE(seed);
        for (const double dt : {1e-3, 5e-3}) {
            Dice dice(seed);
            Rigid rigid = masonry(dice, 2 + seed);
            EXPECT_LT(speed_at_rest(rigid, dt), rest) << "steps of " << dt << " s";
        }
    }
}

// A brick that hangs over the end of the top course tips while the wall settles, in more impacts
// than are worth locating: steps that locate none have to hold the wall all the same.
TEST(Rest, OfAWallOfManyCoursesComesSoonAtLongSteps)
{
    for (int seed = 1; seed <= (number_from("HYORYU_STACKS", 4) + 3) / 4; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(seed);
        const int layers = 2 * (9 + static_cast<int>(dice.between(0, 6)));
        Rigid rigid = masonry(dice, layers);
        EXPECT_LT(speed_at_rest(rigid, 5e-3), 1e-9) << layers << " courses";
        EXPECT_LT(rigid.counters.capped_steps, 200) << "half of the steps";
    }
}

} // namespace
} // namespace hyoryu::test_rest
