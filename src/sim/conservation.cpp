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

bool locked(const Body& body, int axis)
{
    return body.locks[at(axis)];
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
Vec3 weight(const Simulation& sim, Index particles)
{
    Vec3 total = Vec3::Zero();
    if (sim.fluid) {
        total += static_cast<double>(particles) * sim.fluid->parameters.mass *
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

// The totals of the fluid; energies of the domain alone: fluid behind an open side is excluded.
Totals fluid_totals(const Fluid& fluid, const OpenBoundary& open)
{
    const Store& store = fluid.particles.fluid;
    const auto x = store[field::position];
    const auto v = store[field::velocity];
    const auto rho = store[field::density];
    const FluidParameters& f = fluid.parameters;
    const FixedUnit e = sum_units(f).energy;
    const FixedUnit u = sum_units(f).velocity;
    const auto [kinetic, potential, internal, vx, vy, vz, speed] =
        sum_over_fluid<7>(fluid, {e, e, e, u, u, u, u}, [&](Index i) {
            const real norm = v[i].norm();
            if (!open.carpets.empty() && is_behind(open, x[i])) {
                return std::array{0.0, 0.0, 0.0, v[i].x(), v[i].y(), v[i].z(), norm};
            }
            const double s = rho[i] / f.eos.rho0;
            return std::array{0.5 * v[i].squaredNorm(),
                              -f.gravity.dot(x[i]),
                              sq(f.eos.c0) * (std::log(s) + 1 / s - 1),
                              v[i].x(),
                              v[i].y(),
                              v[i].z(),
                              norm};
        });
    return {.fluid_kinetic = f.mass * kinetic,
            .fluid_potential = f.mass * potential,
            .fluid_internal = f.mass * internal,
            .momentum = f.mass * Vec3(vx, vy, vz),
            .momentum_scale = f.mass * speed};
}

} // namespace

Totals totals(const Simulation& sim)
{
    Totals t;
    if (sim.fluid) {
        t = fluid_totals(*sim.fluid, sim.open.boundary);
    }
    for (const Body& body : sim.rigid.bodies) {
        t.body_kinetic += kinetic_energy(body);
        t.momentum += body.mass.mass * body.velocity;
        t.momentum_scale += body.mass.mass * body.velocity.norm();
        t.body_potential -= body.left ? 0 : body.mass.mass * sim.scene.gravity.dot(body.position);
    }
    return t;
}

OutflowBefore outflow_before(const Simulation& sim)
{
    return {sim.fluid ? sim.fluid->lost.momentum : Vec3(Vec3::Zero()), sim.open.boundary.impulse};
}

void update_conservation(Simulation& sim, const StepStart& start, const StateSurvey& end, double dt)
{
    Vec3 walls = outside_impulse(sim, dt);
    for (const Vec3& force : sim.loads.walls) {
        walls -= dt * force;
    }
    walls += sim.waves.sponge_impulse;
    const Vec3 gravity = dt * weight(sim, end.particles);
    const Vec3 lost =
        sim.fluid ? Vec3(sim.fluid->lost.momentum - start.outflow.lost) : Vec3(Vec3::Zero());
    const Vec3 open = sim.open.boundary.impulse - start.outflow.open;
    const Vec3 residual = end.momentum - start.survey.momentum + lost - walls - gravity - open;
    // The impulse of gravity is part of the scale: a fluid at rest has no momentum of its own.
    const double scale =
        std::max({start.survey.momentum_scale, end.momentum_scale, gravity.norm()});
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
