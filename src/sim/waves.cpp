// SPDX-License-Identifier: MIT
#include "hyoryu/sim/waves.hpp"

#include "hyoryu/fluid/sum_units.hpp"
#include "hyoryu/fluid/totals.hpp"
#include "hyoryu/scene/shapes.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

constexpr double strip = 4; // of the fluid before a paddle that is looked at [spacings]
const FixedUnit unit_of_weights = fixed_unit(1); // of sums of weights

// Sum of the weights of the particles before a paddle: 1 at its face, falling to 0 across the
// strip.
double weight_before(const Simulation& sim, const Absorber& absorber)
{
    const Fluid& fluid = *sim.fluid;
    const auto x = fluid.particles.fluid[field::position];
    const Motion& motion = sim.scene.walls[absorber.wall].motion;
    const double face = absorber.face + displacement(motion, sim.clock.time).x();
    const double width = strip * fluid.parameters.spacing;
    const bool planar = sim.scene.dimensions == 2;
    return sum_over_fluid<1>(fluid, {unit_of_weights}, [&](Index i) {
        const double away = absorber.side * (x[i].x() - face);
        const bool before = planar || (x[i].y() >= absorber.low && x[i].y() <= absorber.high);
        return std::array{before && away >= 0 ? std::max(0.0, 1 - away / width) : 0.0};
    })[0];
}

// The side of the paddle on which most of the fluid is.
double side_of_fluid(const Simulation& sim, double middle)
{
    const auto x = sim.fluid->particles.fluid[field::position];
    const Index right = sum(0, sim.fluid->particles.fluid.size(), Index(0),
                            [&](Index i) { return x[i].x() > middle ? Index(1) : Index(-1); });
    return count_over_ranks(*sim.fluid, right) >= 0 ? 1 : -1;
}

// From 0 where the sponge begins to 1 at its side.
double depth_in(const Sponge& sponge, const Vec3& x)
{
    const int axis = sponge.side / 2;
    const double s = (x[axis] - sponge.min[axis]) / (sponge.max[axis] - sponge.min[axis]);
    return sponge.side % 2 == 1 ? s : 1 - s;
}

Vec3 velocity_asked(const Sponge& sponge, const Vec3& x)
{
    const double s = (x.z() - sponge.min.z()) / (sponge.max.z() - sponge.min.z());
    return sponge.parabolic ? 6 * s * (1 - s) * sponge.velocity : sponge.velocity;
}

} // namespace

Waves make_waves(const Simulation& sim)
{
    Waves waves;
    for (std::size_t w = 0; sim.fluid && w < sim.scene.walls.size(); ++w) {
        const Wall& wall = sim.scene.walls[w];
        const auto* solid = std::get_if<SolidWall>(&wall.geometry);
        if (!wall.motion.absorption || solid == nullptr) {
            continue;
        }
        const Bounds box = bounds(wall, sim.scene.dimensions);
        Absorber absorber{.wall = w, .low = box.min.y(), .high = box.max.y()};
        absorber.side = side_of_fluid(sim, solid->centre.x());
        absorber.face = absorber.side > 0 ? box.max.x() : box.min.x();
        absorber.still = weight_before(sim, absorber);
        waves.absorbers.push_back(absorber);
    }
    return waves;
}

void absorb_waves(Simulation& sim, double dt)
{
    const double g = sim.scene.gravity.norm();
    const double now = sim.clock.time;
    for (Absorber& absorber : sim.waves.absorbers) {
        Motion& motion = sim.scene.walls[absorber.wall].motion;
        Motion::Absorption& absorption = *motion.absorption;
        const double depth = absorption.depth;
        const double level =
            absorber.still > 0 ? depth * (weight_before(sim, absorber) / absorber.still - 1) : 0;
        const double memory = strip * sim.fluid->parameters.spacing / std::sqrt(g * depth);
        absorber.level += (level - absorber.level) * -std::expm1(-dt / memory);
        const double lacking = asked_level(motion, now) - absorber.level;
        absorption.place += (now - absorption.time) * absorption.velocity;
        absorption.time = now;
        absorption.velocity = absorber.side * lacking * std::sqrt(g / depth);
        sim.rigid.boundaries[absorber.wall].motion.absorption = absorption;
    }
}

namespace {

// Relaxes the density towards that of the pressure asked for, at the rate c0/L of a passage of
// sound at the side of a sponge of length L. The mass of a particle stays, its volume changes.
void relax_density(const Sponge& sponge, double dt, const Vec3& gravity, Fluid& fluid)
{
    const EquationOfState& eos = fluid.parameters.eos;
    const auto x = fluid.particles.fluid[field::position];
    const auto rho = fluid.particles.fluid[field::density];
    const int axis = sponge.side / 2;
    const double rate = eos.c0 / (sponge.max[axis] - sponge.min[axis]);
    parallel_for(0, fluid.particles.fluid.size(), [&](Index i) {
        if (holds(sponge, x[i], fluid.parameters.dimensions)) {
            const double asked = *sponge.pressure + eos.rho0 * gravity.dot(x[i] - sponge.min);
            const double share = -std::expm1(-dt * rate * sq(depth_in(sponge, x[i])));
            rho[i] += share * (eos.density(asked) - rho[i]);
        }
    });
}

} // namespace

void damp_in_sponges(Simulation& sim, double dt)
{
    Fluid& fluid = *sim.fluid;
    const auto x = fluid.particles.fluid[field::position];
    const auto v = fluid.particles.fluid[field::velocity];
    const FixedUnit unit = sum_units(fluid.parameters).velocity;
    sim.waves.sponge_impulse = Vec3::Zero();
    for (const Sponge& sponge : sim.scene.sponges) {
        if (sponge.pressure) {
            relax_density(sponge, dt, sim.scene.gravity, fluid);
        }
        // At its side; for waves in water of depth d.
        const double g = sim.scene.gravity.norm();
        const double rate = sponge.rate ? *sponge.rate : 10 * std::sqrt(g / sponge.depth.value());
        // Each particle is in one tile, and so is damped once.
        const auto [px, py, pz] = sum_over_fluid<3>(fluid, {unit, unit, unit}, [&](Index i) {
            if (!holds(sponge, x[i], sim.scene.dimensions)) {
                return std::array{0.0, 0.0, 0.0};
            }
            const double share = -std::expm1(-dt * rate * sq(depth_in(sponge, x[i])));
            const Vec3 change = share * (velocity_asked(sponge, x[i]) - v[i]);
            v[i] += change;
            return std::array{change.x(), change.y(), change.z()};
        });
        sim.waves.sponge_impulse += fluid.parameters.mass * Vec3(px, py, pz);
    }
}

} // namespace hyoryu
