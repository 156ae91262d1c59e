// SPDX-License-Identifier: MIT
// Momentum of each body in each step: M dV = impulses of its contacts + its load + M g dt, as the
// step promises, for boxes and cylinders thrown together under loads that change in every step.
// HYORYU_BALANCE=500 looks at that many scenes, HYORYU_SEED is the first.
#include "dice.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

namespace hyoryu::test_balance {
namespace {

using namespace test;

Rigid thrown(Dice& dice)
{
    Rigid rigid = on_floor(0.4, 0.4);
    rigid.boundaries.push_back({"wall", Plane{{0.5, 0, 0}, {-1, 0, 0}}});
    for (int k = 0; k < 8; ++k) {
        const Vec3 place(0.45 * (k % 2) - 0.2, 0.45 * (k / 2 % 2), 0.3 + 0.4 * (k / 4));
        rigid.bodies.push_back(k % 2 == 0 ? box({0.3, 0.15, 0.15}, 500, place)
                                          : body_of(Rod{0.07, 0.3}, 500, place));
        Body& body = rigid.bodies.back();
        const Vec3 axis = dice.within(1) + 2 * Vec3::UnitZ();
        body.orientation = turn_about(axis.normalized(), dice.between(-90, 90));
        body.velocity = dice.within(1.5) + 1.5 * Vec3::UnitX();
    }
    return rigid;
}

std::vector<Vec3> momenta(const Rigid& rigid)
{
    std::vector<Vec3> list;
    for (const Body& body : rigid.bodies) {
        list.emplace_back(body.mass.mass * body.velocity);
    }
    return list;
}

// The largest error of a body's momentum after a step [N s].
double worst_of_step(Rigid& rigid, double time, double dt, Dice& dice)
{
    std::vector<Wrench> loads(rigid.bodies.size());
    std::vector<Vec3> expected = momenta(rigid);
    for (std::size_t b = 0; b < loads.size(); ++b) {
        const double M = rigid.bodies[b].mass.mass;
        loads[b].force = M * g * (dice.within(1) + Vec3::UnitX());
        expected[b] += dt * (loads[b].force + M * rigid.settings.gravity);
    }
    std::vector<Contact> log;
    step(rigid, time, dt, loads, log);
    for (const Contact& c : log) {
        const Vec3 P = c.normal_impulse * c.normal + c.tangential_impulse;
        expected[static_cast<std::size_t>(c.a)] += P;
        if (c.b >= 0) {
            expected[static_cast<std::size_t>(c.b)] -= P;
        }
    }
    const std::vector<Vec3> after = momenta(rigid);
    double worst = 0;
    for (std::size_t b = 0; b < loads.size(); ++b) {
        worst = std::max(worst, (after[b] - expected[b]).norm());
    }
    return worst;
}

TEST(Balance, OfMomentumHoldsForEachBodyInEachStep)
{
    const int first = number_from("HYORYU_SEED", 140);
    for (int seed = first; seed < first + number_from("HYORYU_BALANCE", 6); ++seed) {
        Dice dice(seed);
        Rigid rigid = thrown(dice);
        const double dt = seed % 2 == 0 ? 1.4e-3 : 4e-3;
        for (int k = 0; k < static_cast<int>(0.6 / dt); ++k) {
            // sums of round-off of what goes to and fro in a step
            const double worst = worst_of_step(rigid, dt * k, dt, dice);
            EXPECT_LT(worst, 1e-10) << "HYORYU_SEED=" << seed << " step " << k;
        }
    }
}

} // namespace
} // namespace hyoryu::test_balance
