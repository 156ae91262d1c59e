// SPDX-License-Identifier: MIT
// The last barrier where water is held between a light body and a wall or another light body.
#include "dice.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

namespace hyoryu::test_barrier_pinch {
namespace {

constexpr double spacing = 0.04;
constexpr double particle = 1000 * spacing * spacing; // its mass [kg]
constexpr double dt = 1e-3;

// A box 0.4 m wide that comes down on a floor or on another box, with water between them. It is
// turned a little, so that its corner may hit first.
struct Pinch {
    double gap = 0;               // [m]
    std::array<double, 2> mass{}; // of the upper and the lower box [kg]
    double angle = 0;             // of the upper one, about y [rad]
    Vec3 velocity{0, 0, 0};       // of the upper one [m/s]
    bool floor = true;            // instead of the lower box

    // The height of the lower side of the upper box.
    double roof(double x) const
    {
        return gap + 0.2 * std::tan(std::abs(angle)) - x * std::tan(angle);
    }

    std::string text() const
    {
        const auto body = [](double kg, double z, double turn, const Vec3& v) {
            return fmt::format("[[body]]\nshape = \"box\"\nsize = [0.4, 0, 0.1]\n"
                               "density = {}\nposition = [0, 0, {}]\nvelocity = [{}, 0, {}]\n"
                               "rotation_deg = {{ axis = [0, 1, 0], angle = {} }}\n",
                               kg / 0.04, z, v.x(), v.z(), turn * 180 / std::numbers::pi);
        };
        return "dimensions = 2\n[time]\nend = 10\n[particles]\nspacing = 0.04\n[fluid]\n"
               "[[fluid.block]]\nshape = \"box\"\nmin = [2, 0, 0]\nmax = [2.4, 0, 0.4]\n" +
               body(mass[0], roof(0) + 0.05 / std::cos(angle), angle, velocity) +
               (floor ? "[[wall]]\nshape = \"box\"\nsize = [3, 0, 0.4]\nposition = [0, 0, -0.2]\n"
                      : body(mass[1], -0.05, 0, Vec3(0, 0, 0)));
    }
};

Pinch draw_pinch(Dice& dice, int n)
{
    Pinch pinch;
    pinch.gap = spacing * dice.between(0.05, 0.5);
    for (double& mass : pinch.mass) {
        mass = particle * std::pow(10, dice.between(-1.5, 1));
    }
    pinch.angle = n % 3 == 0 ? 0 : dice.between(-0.07, 0.07);
    pinch.velocity = Vec3{dice.between(-3, 3), 0, dice.between(-8, 0)};
    pinch.floor = n % 2 == 0;
    return pinch;
}

// Places the first few particles between the two.
void place_water(Simulation& sim, const Pinch& pinch, int count, Dice& dice)
{
    for (std::size_t i = 0; i < at(count); ++i) {
        const double x = dice.between(-0.19, 0.19);
        Store& water = sim.fluid->particles.fluid;
        water[field::position][i] = {x, 0, pinch.roof(x) * dice.between(0.05, 0.95)};
        water[field::velocity][i] = {dice.between(-8, 8), 0, dice.between(-3, 3)};
    }
}

// Kinetic energy and momentum of some particles and of the bodies.
struct Motion {
    double energy = 0;
    Vec3 momentum{0, 0, 0};
};

Motion motion_of(const Simulation& sim, int count)
{
    Motion sum;
    const double mass = sim.fluid->parameters.mass;
    const auto v = std::as_const(sim.fluid->particles.fluid)[field::velocity];
    for (std::size_t i = 0; i < at(count); ++i) {
        sum.energy += mass / 2 * v[i].squaredNorm();
        sum.momentum += mass * v[i];
    }
    for (const Body& body : sim.rigid.bodies) {
        sum.energy += kinetic_energy(body);
        sum.momentum += body.mass.mass * body.velocity;
    }
    return sum;
}

// The barrier alone; its loads then move the bodies. Returns the impulse on the walls.
Vec3 hold_and_push(Simulation& sim)
{
    sim.barrier.reset();
    sim.barrier = make_wall_barrier(sim.scene);
    begin_loads(sim);
    hold_at_solids(sim, 0, dt);
    total_loads(sim);
    for (std::size_t b = 0; b < sim.rigid.bodies.size(); ++b) {
        Body& body = sim.rigid.bodies[b];
        body.velocity += dt / body.mass.mass * sim.loads.bodies[b].force;
        body.angular_momentum += dt * sim.loads.bodies[b].torque;
    }
    Vec3 impulse(0, 0, 0);
    for (const Vec3& force : sim.loads.walls) {
        impulse += dt * force;
    }
    return impulse;
}

// A particle between a wall and a light body takes an impulse of both in several rounds. If the
// body takes a share of its own, what the wall has answered to the rest must go, too. With the
// whole answer the energy grew in a third of these draws, up to 23 times. Known to fail: it grew in
// 24 of 8,000 other draws, by a quarter at most, since bodies do not know of each other's hits and
// several rounds need not end; between two bodies by 3 % at most in these.
TEST(BarrierPinch, AddsNoEnergyAndNoMomentum)
{
    Dice dice(7);
    int yielded = 0;
    for (int n = 0; n < 400; ++n) {
        const Pinch pinch = draw_pinch(dice, n);
        SCOPED_TRACE(pinch.text());
        Simulation sim = make(pinch.text());
        const int count = 1 + n % 4;
        place_water(sim, pinch, count, dice);
        const Motion before = motion_of(sim, count);
        const Vec3 on_walls = hold_and_push(sim);
        const Motion after = motion_of(sim, count);
        const double most = pinch.floor ? 1 + 1e-9 : 1.05;
        EXPECT_LE(after.energy, most * before.energy);
        EXPECT_LT((after.momentum + on_walls - before.momentum).norm(), 1e-9 * particle);
        if (!(sim.loads.of_hits.of(0).back() > 1)) {
            continue; // all impulses are those of the first rounds
        }
        yielded += 1;
        const Store& water = sim.fluid->particles.fluid;
        for (std::size_t i = 0; i < at(count) && pinch.floor; ++i) {
            const bool touches = water[field::position][i].z() < 0.2 * spacing;
            EXPECT_TRUE(!touches || water[field::velocity][i].z() > -1e-9) << "into the floor";
        }
    }
    EXPECT_GT(yielded, 100) << "draws in which the upper box yields";
}

} // namespace
} // namespace hyoryu::test_barrier_pinch
