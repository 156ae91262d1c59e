// SPDX-License-Identifier: MIT
// Momentum of each body in each step: M dV = impulses of its contacts + its load + M g dt, as the
// step promises, for boxes and cylinders thrown together under loads that change in every step.
// HYORYU_BALANCE=300 runs that many scenes.
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <numeric>
#include <random>

namespace hyoryu {
namespace {

using namespace test;

Rigid thrown(std::mt19937& numbers)
{
    std::uniform_real_distribution<double> unit(-1, 1);
    Rigid rigid = on_floor(0.4, 0.4);
    rigid.boundaries.push_back({"wall", Plane{{0.5, 0, 0}, {-1, 0, 0}}});
    for (int k = 0; k < 8; ++k) {
        const Vec3 place(0.45 * (k % 2) - 0.2, 0.45 * (k / 2 % 2), 0.3 + 0.4 * (k / 4));
        rigid.bodies.push_back(k % 2 == 0 ? box({0.3, 0.15, 0.15}, 500, place)
                                          : body_of(Rod{0.07, 0.3}, 500, place));
        Body& body = rigid.bodies.back();
        body.orientation =
            turn_about(Vec3(unit(numbers), unit(numbers), 1).normalized(), 90 * unit(numbers));
        body.velocity = 1.5 * Vec3(unit(numbers) + 1, unit(numbers), unit(numbers));
    }
    return rigid;
}

TEST(Balance, OfMomentumHoldsForEachBodyInEachStep)
{
    std::uniform_real_distribution<double> unit(-1, 1);
    const char* wanted = std::getenv("HYORYU_BALANCE");
    // Without it those of the first sixty that have found faults, and two more.
    std::vector<int> scenes{0, 1, 7, 22, 41, 59};
    if (wanted != nullptr) {
        scenes.resize(static_cast<std::size_t>(std::atoi(wanted)));
        std::iota(scenes.begin(), scenes.end(), 0);
    }
    for (const int scene : scenes) {
        std::mt19937 numbers(static_cast<unsigned>(scene));
        Rigid rigid = thrown(numbers);
        const double dt = scene % 2 == 0 ? 1.4e-3 : 4e-3;
        std::vector<Wrench> loads(rigid.bodies.size());
        for (int k = 0; k < static_cast<int>(0.6 / dt); ++k) {
            std::vector<Vec3> expected;
            for (std::size_t b = 0; b < loads.size(); ++b) {
                const double M = rigid.bodies[b].mass.mass;
                loads[b].force = M * g * Vec3(unit(numbers) + 1, unit(numbers), unit(numbers));
                expected.emplace_back(M * rigid.bodies[b].velocity +
                                      dt * (loads[b].force + M * rigid.settings.gravity));
            }
            std::vector<Contact> log;
            step(rigid, dt * k, dt, loads, log);
            for (const Contact& c : log) {
                const Vec3 P = c.normal_impulse * c.normal + c.tangential_impulse;
                expected[static_cast<std::size_t>(c.a)] += P;
                if (c.b >= 0) {
                    expected[static_cast<std::size_t>(c.b)] -= P;
                }
            }
            for (std::size_t b = 0; b < loads.size(); ++b) {
                const Body& body = rigid.bodies[b];
                // sums of round-off of what goes to and fro in a step
                ASSERT_LT((body.mass.mass * body.velocity - expected[b]).norm(), 1e-10)
                    << "scene " << scene << " step " << k << " body " << b;
            }
        }
    }
}

} // namespace
} // namespace hyoryu
