// SPDX-License-Identifier: MIT
// Bodies whose centre of mass is not the middle of their shape.
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/rigid_scene.hpp"
#include "hyoryu/sim/frames.hpp"
#include "hyoryu/sim/simulation.hpp"

#include "dice.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

namespace hyoryu::test_centre_of_mass {
namespace {

Simulation started(const std::string& text)
{
    const Scene scene = parse_case(text, "case.toml");
    const Filling filling = fill(scene);
    return make_simulation(scene, make_plan(scene, filling), filling);
}

std::string head(int dimensions, double gravity)
{
    return fmt::format("dimensions = {}\ngravity = [0, 0, {}]\n[time]\nend = 10\nstep = 0.001\n"
                       "[particles]\nspacing = 0.1\n",
                       dimensions, -gravity);
}

// T = 2 pi sqrt((I + m (r - e)^2) / (m g e)) of a ball, rod or disc whose centre of mass lies e
// below its middle and that rolls to and fro; without friction I alone turns.
TEST(CentreOfMass, RoundBodiesRockWithThePeriodOfTheirOffset)
{
    Dice dice(3);
    for (int n = 0; n < 8; ++n) {
        const int dimensions = n % 3 == 0 ? 2 : 3;
        const bool rod = dimensions == 3 && n % 2 == 0;
        const bool rolls = dice.chance(0.6);
        const double r = dice.between(0.3, 0.8);
        const double e = dice.between(0.2, 0.6) * r;
        const double m = dice.between(1, 9);
        const double I = dice.between(0.2, 0.5) * m * r * r;
        const double swing = 0.01; // small: the period grows by swing^2 / 16 and less
        const double angular = swing * std::sqrt(9.81 * m * e / (I + (rolls ? m * sq(r - e) : 0)));
        const std::string shape =
            rod ? fmt::format("shape = \"cylinder\"\nradius = {}\nlength = 1.5\nrotation_deg = {{ "
                              "axis = [0, 0, 1], angle = 90 }}\n",
                              r)
                : fmt::format("shape = \"sphere\"\nradius = {}\n", r);
        Simulation sim = started(
            head(dimensions, 9.81) +
            fmt::format("[contact]\nrestitution = 0\nfriction = {}\n[[wall]]\nshape = \"plane\"\n"
                        "point = [0, 0, 0]\nnormal = [0, 0, 1]\n[[body]]\n{}mass = {}\n"
                        "center_of_mass = [0, 0, {}]\ninertia = [{}, {}, {}]\nposition = [0, 0, {}]"
                        "\nvelocity = [{}, 0, 0]\nangular_velocity = [0, {}, 0]\n",
                        rolls ? 2 : 0, shape, m, -e, I, I, I, r - e, rolls ? angular * (r - e) : 0,
                        angular));
        std::vector<double> turns;
        double last = angular;
        while (turns.size() < 2 && sim.clock.time < 9.9) {
            step(sim);
            const double now = angular_velocity(sim.rigid.bodies[0]).y();
            if (last * now < 0) {
                turns.push_back(sim.clock.time - sim.clock.dt * now / (now - last));
            }
            last = now;
        }
        ASSERT_EQ(turns.size(), 2U) << n;
        const double period =
            2 * std::numbers::pi * std::sqrt((I + (rolls ? m * sq(r - e) : 0)) / (m * 9.81 * e));
        // the swing, and the time step of first order with friction
        EXPECT_NEAR(2 * (turns[1] - turns[0]) / period, 1, 2e-3) << n << " " << rod << rolls;
    }
}

TEST(CentreOfMass, FreeRotationKeepsTheAngularMomentumAndTheSurfaceFollows)
{
    Dice dice(11);
    for (int n = 0; n < 6; ++n) {
        const Vec3 c{dice.between(-0.4, 0.4), dice.between(-0.3, 0.3), dice.between(-0.2, 0.2)};
        const Vec3 spin{dice.between(-3, 3), dice.between(-3, 3), dice.between(-3, 3)};
        Simulation sim = started(
            head(3, 0) +
            fmt::format("[[body]]\nshape = \"box\"\nsize = [1, 0.8, 0.6]\nmass = 5\ncenter_of_mass "
                        "= [{}, {}, {}]\ninertia = [0.5, 0.7, 0.9]\nposition = [1, 2, 3]\nvelocity "
                        "= [1, 0, 0]\nangular_velocity = [{}, {}, {}]\n",
                        c.x(), c.y(), c.z(), spin.x(), spin.y(), spin.z()));
        const Vec3 L = sim.rigid.bodies[0].angular_momentum;
        for (int k = 0; k < 500; ++k) {
            step(sim);
        }
        const Body& body = sim.rigid.bodies[0];
        EXPECT_LE((body.angular_momentum - L).norm(), 1e-12 * L.norm());
        EXPECT_NEAR(body.position.x(), 1 + sim.clock.time, 1e-12);
        // The mean of the corners of the surface is the middle of the shape.
        const Surface surface = body_surface(sim);
        Vec3 middle = Vec3::Zero();
        for (std::size_t k = 0; k < surface.points.size(); ++k) {
            middle[static_cast<Index>(k % 3)] +=
                surface.points[k] / static_cast<double>(surface.points.size() / 3);
        }
        EXPECT_LT((middle - (body.position - body.orientation * c)).norm(), 1e-5); // floats
    }
}

// A box meets a plane as the polytope whose corners were shifted by hand does.
TEST(CentreOfMass, BoxesBounceAsTheSameCornersShiftedByHand)
{
    Dice dice(5);
    for (int n = 0; n < 4; ++n) {
        const Vec3 c{dice.between(-0.4, 0.4), dice.between(-0.3, 0.3), dice.between(-0.2, 0.2)};
        Simulation sim = started(
            head(3, 9.81) +
            fmt::format("[[wall]]\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n"
                        "[[body]]\nshape = \"box\"\nsize = [1, 0.8, 0.6]\nmass = 5\ncenter_of_mass "
                        "= [{}, {}, {}]\ninertia = [0.5, 0.7, 0.9]\nposition = [0, 0, 1.4]\n"
                        "angular_velocity = [1, 2, 0.5]\n",
                        c.x(), c.y(), c.z()));
        Rigid by_hand = make_rigid(sim.scene);
        Polytope& box = std::get<Polytope>(by_hand.bodies[0].shape);
        for (std::size_t k = 0; k < box.corners.size(); ++k) {
            const Vec3 half(0.5, 0.4, 0.3);
            for (Index axis = 0; axis < 3; ++axis) {
                const bool high = ((k >> axis) & 1U) != 0;
                box.corners[k][axis] = (high ? half[axis] : -half[axis]) - c[axis];
            }
        }
        std::vector<Contact> log;
        const std::vector<Wrench> none(1);
        for (int k = 0; k < 800; ++k) {
            step(by_hand, 0.001 * k, 0.001, none, log);
            step(sim);
        }
        EXPECT_FALSE(log.empty());
        EXPECT_LT((sim.rigid.bodies[0].position - by_hand.bodies[0].position).norm(), 1e-12);
    }
}

} // namespace
} // namespace hyoryu::test_centre_of_mass
