// SPDX-License-Identifier: MIT
// The impulse of one contact, judged by the conditions of Coulomb friction alone.
#include "dice.hpp"
#include "rigid/contact/cone.hpp"

#include <gtest/gtest.h>

namespace hyoryu::test_cone {
namespace {

using namespace test;

// A contact, and the velocity with which its bodies come on.
struct Drawn {
    Cone cone;
    Vec3 b{0, 0, 0};
};

Drawn drawn(int seed)
{
    Dice dice(seed);
    Mat3 turns; // what unit impulses turn the bodies by
    turns << dice.within(1), dice.within(1), dice.within(1);
    Drawn d;
    d.cone.K = dice.between(0.1, 10) * (Mat3::Identity() + turns.transpose() * turns);
    d.cone.size = 3;
    d.cone.mu = dice.between(0.05, 0.6);
    invert(d.cone);
    d.b = {-dice.between(0.1, 2), dice.between(-5, 5), dice.between(-5, 5)};
    return d;
}

// What is left of the conditions: no normal velocity, and friction on the cone against the slip or
// within it without slip [m/s].
double violated(const Drawn& d, const Vec3& p)
{
    const Vec3 u = d.b + d.cone.K * p;
    const double least = 1e-12 * d.b.norm();
    const double slip = std::hypot(u[1], u[2]);
    const double friction = std::hypot(p[1], p[2]);
    double most = std::abs(u[0]) + std::max(0.0, -p[0]);
    most = std::max(most, d.cone.K(1, 1) * (friction - d.cone.mu * p[0]));
    if (slip > least) {
        most = std::max(most, d.cone.K(1, 1) * std::abs(friction - d.cone.mu * p[0]));
        most = std::max(most, std::abs(u[1] * p[2] - u[2] * p[1]) / friction);
        most = std::max(most, (u[1] * p[1] + u[2] * p[2]) / friction);
    }
    return most;
}

// To the round-off of numbers of this size, a thousand times over.
TEST(Cone, ImpulsesObeyCoulombsLaw)
{
    int slides = 0;
    for (int seed = 1; seed <= 500; ++seed) {
        const Drawn d = drawn(seed);
        const Vec3 p = cone_impulse(d.cone, d.b, Vec3::Zero()).p;
        EXPECT_LT(violated(d, p), 1e-12 * d.b.norm()) << seed;
        slides += (d.b + d.cone.K * p).tail<2>().norm() > 1e-6 ? 1 : 0;
    }
    EXPECT_GT(slides, 100);
}

// The step that sweeps take leaves the exact impulse alone, and leads to it from directions that
// are off by up to 0.3 rad.
TEST(Cone, NearerImpulsesEndAtTheExactOne)
{
    for (int seed = 1; seed <= 500; ++seed) {
        const Drawn d = drawn(seed);
        const Vec3 exact = cone_impulse(d.cone, d.b, Vec3::Zero()).p;
        const double round_off = 1e-13 * exact.norm();
        EXPECT_LT((nearer_impulse(d.cone, d.b, exact).p - exact).norm(), round_off) << seed;
        Dice dice(seed);
        const double angle = dice.between(-0.3, 0.3);
        Vec3 p = Eigen::AngleAxisd(angle, Vec3::UnitX()) * exact;
        for (int k = 0; k < 8; ++k) {
            p = nearer_impulse(d.cone, d.b, p).p;
        }
        EXPECT_LT((p - exact).norm(), round_off) << seed;
    }
}

} // namespace
} // namespace hyoryu::test_cone
