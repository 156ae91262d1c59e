// SPDX-License-Identifier: MIT
// Scenes drawn at random: whatever a scene holds, the numbers stay finite, nothing leaves the
// basin, solids do not overlap, energy does not grow and momentum closes. A scene follows from its
// seed alone; HYORYU_SCENES=1000 is the nightly size, HYORYU_SEED the first seed,
// HYORYU_SHOW=1 prints the cases.
#include "../dice.hpp"
#include "hyoryu/core/error.hpp"
#include "runs.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cstdlib>

namespace hyoryu {
namespace {

constexpr double spacing = 0.04;
constexpr double length = 2.0;
constexpr double height = 1.2;
constexpr double pitch = 0.4; // of the places where bodies start: none overlaps another

// One draw a statement: the order of arguments is the compiler's.
std::string fluid_of(Dice& dice, double width)
{
    const char* formulation = dice.chance(0.2) ? "mps" : "sph";
    const double alpha = dice.between(0.01, 0.1);
    const double depth = dice.between(0.2, 0.6);
    const double speed = dice.chance(0.3) ? dice.between(0, 1.5) : 0;
    return fmt::format("[fluid]\nformulation = \"{}\"\n[fluid.viscosity]\nalpha = {}\n"
                       "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\n"
                       "max = [{}, 0, {}]\nvelocity = [{}, 0, 0]\n",
                       formulation, alpha, width, depth, speed);
}

std::string shape_of(Dice& dice)
{
    const double least = 3 * spacing;
    const double most = pitch / 1.5; // its diagonal stays within its place
    const double a = dice.between(least, most);
    const double b = dice.between(least, most);
    return dice.chance(0.5) ? fmt::format("shape = \"box\"\nsize = [{}, 1, {}]\n", a, b)
                            : fmt::format("shape = \"sphere\"\nradius = {}\n", 0.5 * a);
}

std::string body_of(Dice& dice, int k, double x, double z)
{
    const std::string shape = shape_of(dice);
    const double density = std::pow(10.0, dice.between(1.7, 3.7));
    const double angle = dice.between(0, 360);
    const double vx = dice.between(-2, 2);
    const double vz = dice.between(-2, 2);
    const double spin = dice.between(-10, 10);
    return fmt::format("[[body]]\nname = \"body{}\"\n{}density = {}\nposition = [{}, 0, {}]\n"
                       "rotation_deg = {{ axis = [0, 1, 0], angle = {} }}\n"
                       "velocity = [{}, 0, {}]\nangular_velocity = [0, {}, 0]\n",
                       k, shape, density, x, z, angle, vx, vz, spin);
}

std::string bodies_of(Dice& dice, double first)
{
    std::string text;
    int count = 0;
    for (double z = 0.5 * pitch; z < height; z += pitch) {
        for (double x = first + 0.5 * pitch; x <= length - 0.5 * pitch; x += pitch) {
            text += dice.chance(0.5) ? body_of(dice, count++, x, z) : "";
        }
    }
    return text;
}

std::string scene_of(std::uint64_t seed)
{
    Dice dice(seed);
    const double width = dice.between(0.3, 0.9);
    const bool wet = dice.chance(0.8);
    const double restitution = dice.between(0, 0.8);
    const double friction = dice.between(0, 0.8);
    std::string text = fmt::format("title = \"scene {}\"\ndimensions = 2\n[time]\nend = 0.4\n"
                                   "[particles]\nspacing = {}\n[contact]\nrestitution = {}\n"
                                   "friction = {}\n[output]\nevery = 0.1\n[[wall]]\n"
                                   "name = \"basin\"\nshape = \"basin\"\nmin = [0, 0, 0]\n"
                                   "max = [{}, 0, {}]\nopen = [\"+z\"]\n",
                                   seed, spacing, restitution, friction, length, height);
    text += wet ? fluid_of(dice, width) : "";
    return text + bodies_of(dice, wet ? width : 0);
}

double energy(const Totals& t)
{
    return t.fluid_kinetic + t.fluid_potential + t.fluid_internal + t.body_kinetic +
           t.body_potential;
}

double deepest_overlap(const Simulation& sim)
{
    double deepest = 0;
    const auto bodies = static_cast<int>(sim.rigid.bodies.size());
    for (int a = 0; a < bodies; ++a) {
        for (int b = -1; b < a; ++b) {
            deepest = std::max(deepest, overlap(sim.rigid, a, b, sim.clock.time));
        }
    }
    return deepest;
}

// Fluid beside or below the basin; what splashed over its rim is on its way out.
Index escaped(const Simulation& sim)
{
    constexpr double graze = 0.5 * spacing; // a particle is half a spacing wide
    const Rows rows = sim.fluid->particles.fluid.rows();
    const auto x = sim.fluid->particles.fluid[field::position];
    Index count = 0;
    for (Index i = rows.begin; i < rows.end; ++i) {
        const Vec3& p = x[static_cast<std::size_t>(i)];
        const bool inside = p.x() > -graze && p.x() < length + graze && p.z() > -graze;
        count += inside || p.z() > height ? 0 : 1;
    }
    return count;
}

void expect_sound(const Simulation& sim)
{
    const Totals now = totals(sim);
    const Totals& start = sim.conservation.start;
    // Everything falls: what there is to gain is potential energy over the floor, which `start`
    // holds in full. 1 % for the sums in floats and for the compression at the start.
    EXPECT_LE(energy(now), energy(start) + 0.01 * std::abs(energy(start)));
    // Half a spacing in passing, as impacts of a jam are not located in time, a tenth at rest: less
    // than the fluid can tell of a surface made of particles.
    EXPECT_LE(sim.rigid.counters.worst_penetration, 0.5 * spacing) << "solids, on the way";
    EXPECT_LE(deepest_overlap(sim), 0.1 * spacing) << "solids, at the end";
    if (sim.fluid) {
        EXPECT_EQ(escaped(sim), 0) << "particles through walls";
        EXPECT_EQ(sim.fluid->lost.count, 0);
        if (sim.fluid->parameters.formulation == FormulationKind::sph) { // MPS does not promise it
            EXPECT_LT(sim.conservation.worst_closure, 6e-8)
                << "half a unit of the last place of a float";
        }
    }
}

TEST(RandomScenes, StaySound)
{
    const int first = number_from("HYORYU_SEED", 1);
    const int count = number_from("HYORYU_SCENES", 50);
    for (int seed = first; seed < first + count; ++seed) {
        SCOPED_TRACE(fmt::format("HYORYU_SEED={} HYORYU_SCENES=1", seed));
        const std::string text = scene_of(static_cast<std::uint64_t>(seed));
        if (std::getenv("HYORYU_SHOW") != nullptr) {
            fmt::print("{}", text);
        }
        Simulation sim = make(text);
        try {
            while (!finished(sim.clock, sim.scene)) {
                step_on(sim);
            }
        } catch (const NumericalError& error) {
            ADD_FAILURE() << error.what();
        }
        expect_sound(sim);
    }
}

} // namespace
} // namespace hyoryu
