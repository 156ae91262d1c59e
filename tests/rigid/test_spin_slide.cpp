// SPDX-License-Identifier: MIT
// Solids that slide and spin at once: the direction of friction turns in each step, and the motion
// is of second order in the step all the same. HYORYU_MEETINGS=500 runs that many, HYORYU_SEED is
// the first.
#include "dice.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

namespace hyoryu::test_spin_slide {
namespace {

using namespace test;

// A box, a cylinder on its end, or one that lies.
Body slider(int seed, Dice& dice)
{
    const double a = dice.between(0.1, 0.3);
    const double b = dice.between(0.1, 0.3);
    const double c = dice.between(0.02, 0.1);
    Body body;
    switch (seed % 3) {
    case 0:
        body = box({a, b, c}, 500, {0, 0, c / 2});
        break;
    case 1:
        body = body_of(Rod{a / 2, c}, 500, {0, 0, c / 2});
        body.orientation = turn_about(Vec3::UnitY(), 90);
        break;
    default:
        body = body_of(Rod{c / 2, b}, 500, {0, 0, c / 2});
    }
    body.velocity = {dice.between(1, 2), dice.between(-0.5, 0.5), 0};
    body.angular_momentum = angular_momentum(body, {0, 0, dice.between(2, 10)});
    return body;
}

// Where it is after 0.12 s, while it slides.
Vec3 place_after(const Body& body, double mu, double dt)
{
    Rigid rigid = on_floor(0, mu);
    rigid.bodies.push_back(body);
    run(rigid, dt, static_cast<int>(std::lround(0.12 / dt)));
    return rigid.bodies[0].position;
}

TEST(SpinSlide, IsOfSecondOrder)
{
    const int first = number_from("HYORYU_SEED", 1);
    for (int seed = first; seed < first + number_from("HYORYU_MEETINGS", 30); ++seed) {
        Dice dice(seed);
        const Body body = slider(seed, dice);
        const double mu = dice.between(0.1, 0.4);
        const Vec3 coarse = place_after(body, mu, 8e-3);
        const Vec3 middle = place_after(body, mu, 4e-3);
        const Vec3 fine = place_after(body, mu, 2e-3);
        // Richardson's order: four times nearer for half the step, 3.48 for 1.8; and to the noise
        // of where a patch rubs, 1e-8 m.
        EXPECT_LT((middle - fine).norm(), (coarse - middle).norm() / 3.48 + 1e-9) << seed;
        EXPECT_LT((middle - fine).norm(), 1e-6) << seed;
    }
}

} // namespace
} // namespace hyoryu::test_spin_slide
