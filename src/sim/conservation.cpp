// SPDX-License-Identifier: MIT
#include "hyoryu/sim/conservation.hpp"

#include "hyoryu/fluid/sum_units.hpp"
#include "hyoryu/fluid/totals.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hyoryu {

namespace {

std::size_t at(Index row)
{
    return static_cast<std::size_t>(row);
}

struct MomentumSum {
    Vec3 momentum{0, 0, 0};
    double scale = 0;
};

bool locked(const Body& body, int axis)
{
    return body.locks[static_cast<std::size_t>(axis)];
}

// Momentum of fluid and bodies.
MomentumSum motion(const Simulation& sim)
{
    MomentumSum all;
    if (sim.fluid) {
        const auto v = sim.fluid->particles.fluid[field::velocity];
        const FluidParameters& f = sim.fluid->parameters;
        const FixedUnit unit = sum_units(f).velocity;
        const auto [x, y, z, speed] =
            sum_over_fluid<4>(*sim.fluid, {unit, unit, unit, unit}, [&](Index i) {
                return std::array{v[i].x(), v[i].y(), v[i].z(), v[i].norm()};
            });
        all = {f.mass * Vec3(x, y, z), f.mass * speed};
    }
    for (const Body& body : sim.rigid.bodies) {
        all.momentum += body.mass.mass * body.velocity;
        all.scale += body.mass.mass * body.velocity.norm();
    }
    return all;
}

// Impulse of contacts with walls, and of the constraints on the locked axes of bodies, which cancel
// all other impulses along them.
Vec3 outside_impulse(const Simulation& sim, double dt)
{
    Vec3 impulse = Vec3::Zero();
    std::vector<Vec3> received(sim.rigid.bodies.size(), Vec3::Zero());
    for (const Contact& c : sim.contacts) {
        const Vec3 P = c.normal_impulse * c.normal + c.tangential_impulse;
        received[at(c.a)] += P;
        if (c.b >= 0) {
            received[at(c.b)] -= P;
        } else {
            impulse += P;
        }
    }
    for (std::size_t b = 0; b < sim.rigid.bodies.size(); ++b) {
        const Body& body = sim.rigid.bodies[b];
        for (int axis = 0; axis < 3; ++axis) {
            if (locked(body, axis)) {
                const double load = sim.loads.bodies.empty() ? 0 : sim.loads.bodies[b].force[axis];
                impulse[axis] -= received[b][axis] + dt * load;
            }
        }
    }
    return impulse;
}

// Weight and driving force of the fluid [N], without the weight along locked axes.
Vec3 weight(const Simulation& sim)
{
    Vec3 total = Vec3::Zero();
    if (sim.fluid) {
        const Index count = count_over_ranks(*sim.fluid, sim.fluid->particles.fluid.size());
        total += static_cast<double>(count) * sim.fluid->parameters.mass *
                 (sim.scene.gravity + sim.fluid->parameters.drive);
    }
    for (const Body& body : sim.rigid.bodies) {
        for (int axis = 0; axis < 3; ++axis) {
            const bool free = !body.left && !locked(body, axis);
            total[axis] += free ? body.mass.mass * sim.scene.gravity[axis] : 0;
        }
    }
    return total;
}

struct FluidEnergy {
    double kinetic = 0, potential = 0, internal = 0;
};

// Of the domain: what is behind an open side counts no more, or not yet.
FluidEnergy fluid_energy(const Fluid& fluid, const OpenBoundary& open)
{
    const Store& store = fluid.particles.fluid;
    const auto x = store[field::position];
    const auto v = store[field::velocity];
    const auto rho = store[field::density];
    const FluidParameters& f = fluid.parameters;
    const FixedUnit unit = sum_units(f).energy;
    const auto [kinetic, potential, internal] =
        sum_over_fluid<3>(fluid, {unit, unit, unit}, [&](Index i) {
            if (!open.carpets.empty() && is_behind(open, x[i], f.spacing)) {
                return std::array{0.0, 0.0, 0.0};
            }
            const double s = rho[i] / f.eos.rho0;
            return std::array{0.5 * v[i].squaredNorm(), -f.gravity.dot(x[i]),
                              sq(f.eos.c0) * (std::log(s) + 1 / s - 1)};
        });
    return {f.mass * kinetic, f.mass * potential, f.mass * internal};
}

} // namespace

Totals totals(const Simulation& sim)
{
    Totals t;
    if (sim.fluid) {
        const FluidEnergy e = fluid_energy(*sim.fluid, sim.open.boundary);
        t.fluid_kinetic = e.kinetic;
        t.fluid_potential = e.potential;
        t.fluid_internal = e.internal;
    }
    for (const Body& body : sim.rigid.bodies) {
        t.body_kinetic += kinetic_energy(body);
        t.body_potential -= body.left ? 0 : body.mass.mass * sim.scene.gravity.dot(body.position);
    }
    const MomentumSum all = motion(sim);
    t.momentum = all.momentum;
    t.momentum_scale = all.scale;
    return t;
}

MomentumBefore momentum_before(const Simulation& sim)
{
    const MomentumSum all = motion(sim);
    return {all.momentum, sim.fluid ? sim.fluid->lost.momentum : Vec3(Vec3::Zero()),
            sim.open.boundary.impulse, all.scale};
}

void update_conservation(Simulation& sim, const MomentumBefore& before, double dt)
{
    const MomentumSum after = motion(sim);
    Vec3 walls = outside_impulse(sim, dt);
    for (const Vec3& force : sim.loads.walls) {
        walls -= dt * force;
    }
    walls += sim.waves.sponge_impulse;
    const Vec3 gravity = dt * weight(sim);
    const Vec3 lost = sim.fluid ? Vec3(sim.fluid->lost.momentum - before.lost) : Vec3(Vec3::Zero());
    const Vec3 open = sim.open.boundary.impulse - before.open;
    const Vec3 residual = after.momentum - before.momentum + lost - walls - gravity - open;
    // The impulse of gravity is part of the scale: a fluid at rest has no momentum of its own.
    const double scale = std::max({before.scale, after.scale, gravity.norm()});
    sim.conservation.wall_impulse += walls;
    sim.conservation.gravity_impulse += gravity;
    if (scale > 0) {
        sim.conservation.worst_closure =
            std::max(sim.conservation.worst_closure, residual.norm() / scale);
    }
    for (const Contact& contact : sim.contacts) {
        sim.conservation.contact_loss += contact.energy_lost;
    }
}

} // namespace hyoryu
