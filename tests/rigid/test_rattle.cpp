// SPDX-License-Identifier: MIT
// A light body that rattles between a heavy one and the ground has more impacts in a step than are
// located; those that are not must not let them go into each other.
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace hyoryu {
namespace {

using namespace test;

// A tenth of what the heavy box closes by in a step of 5 ms, some 25 mm.
constexpr double shallow = 2.5e-3;

double deepest_overlap(const Rigid& rigid, double time)
{
    double most = 0;
    for (int a = 0; a < static_cast<int>(rigid.bodies.size()); ++a) {
        most = std::max(most, overlap(rigid, a, -1, time));
        for (int b = a + 1; b < static_cast<int>(rigid.bodies.size()); ++b) {
            most = std::max(most, overlap(rigid, a, b, time));
        }
    }
    return most;
}

TEST(Rattle, LightBoxesUnderHeavyOnesStayOutOfThemAndOfTheGround)
{
    std::mt19937 random(1);
    const auto between = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    };
    for (int draw = 0; draw < 60; ++draw) {
        Rigid rigid = on_floor(between(0, 0.3), between(0.1, 0.5));
        const auto add = [&](const Vec3& size, double density, double z, double down, double spin) {
            Body body = box(size, density, {between(-0.02, 0.02), between(-0.02, 0.02), z});
            body.orientation = turn_about(
                Vec3(between(-1, 1), between(-1, 1), between(-1, 1)).normalized(), between(0, 180));
            body.velocity = {0, 0, -down};
            body.angular_momentum =
                angular_momentum(body, spin * Vec3(between(-1, 1), between(-1, 1), between(-1, 1)));
            rigid.bodies.push_back(body);
        };
        add({0.2, 0.16, 0.18}, 100, 0.2, 2, 20);
        add({0.4, 0.3, 0.2}, between(1500, 3000), 0.66, 4, 5);
        double most = 0;
        run(rigid, 5e-3, 80, [&](double t) { most = std::max(most, deepest_overlap(rigid, t)); });
        EXPECT_LE(most, shallow) << "draw " << draw;
    }
}

} // namespace
} // namespace hyoryu
