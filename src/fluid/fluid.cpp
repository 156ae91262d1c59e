// SPDX-License-Identifier: MIT
#include "hyoryu/fluid/fluid.hpp"

#include <cmath>

namespace hyoryu {

namespace {

auto at(Index row)
{
    return static_cast<std::size_t>(row);
}

// Mass of the fluid that a solid particle stands in for.
real stand_in_mass(const Fluid& fluid, Index row)
{
    const std::int32_t owner = fluid.particles.owner()[at(row)];
    return owner >= 0 ? fluid.body_particle_mass[at(owner)] : fluid.parameters.mass;
}

} // namespace

void allocate(Fluid& fluid, Index fluid_count, Index wall_count, Index body_count)
{
    using Core = Fields<Position, Velocity, Density, DensityRate, Volume, Pressure, Force>;
    using Solid = WallExtrapolation::Writes;
    std::visit(
        [&](const auto&... effect) {
            using Own = Union<Core, typename std::remove_cvref_t<decltype(effect)>::Writes...>;
            if (wall_count + body_count > 0) {
                fluid.particles.allocate(Union<Own, Solid>{}, fluid_count, wall_count, body_count);
            } else {
                fluid.particles.allocate(Own{}, fluid_count, wall_count, body_count);
            }
        },
        fluid.effects.diffusion, fluid.effects.viscosity);
}

void drift(Fluid& fluid, real dt)
{
    Particles& particles = fluid.particles;
    const auto x = particles[field::position];
    const auto v = particles[field::velocity];
    const auto rho = particles[field::density];
    const auto rate = particles[field::density_rate];
    const Rows rows = particles.fluid();
    parallel_for(rows.begin, rows.end, [&](Index i) {
        rho[at(i)] += dt * rate[at(i)];
        x[at(i)] += dt * v[at(i)];
    });
}

void update_pressure(Fluid& fluid)
{
    Particles& particles = fluid.particles;
    const FluidParameters& f = fluid.parameters;
    const auto rho = particles[field::density];
    const auto p = particles[field::pressure];
    const auto V = particles[field::volume];
    const Rows rows = particles.fluid();
    parallel_for(rows.begin, rows.end, [&](Index i) {
        p[at(i)] = f.eos.pressure(rho[at(i)]);
        V[at(i)] = f.mass / rho[at(i)];
    });
    fluid.records.load(particles);
    const Rows solid = particles.solid();
    if (solid.size() == 0) {
        return;
    }

    clear(particles, solid, WallExtrapolation::Writes{});
    sweep(particles, fluid.neighbours.solid_fluid, fluid.records, fluid.kernel,
          WallExtrapolation{f.eos, f.gravity});
    const auto shepard = particles[field::shepard_sum];
    const auto weighted = particles[field::pressure_sum];
    parallel_for(solid.begin, solid.end, [&](Index i) {
        const real p_w = shepard[at(i)] > 0 ? positive(weighted[at(i)] / shepard[at(i)]) : 0;
        p[at(i)] = p_w;
        rho[at(i)] = f.eos.density(p_w);
        V[at(i)] = stand_in_mass(fluid, i) / rho[at(i)];
    });
    fluid.records.load(particles, Fields<Volume, Pressure>{});
}

void update_forces(Fluid& fluid, real dt)
{
    Particles& particles = fluid.particles;
    const FluidNeighbours& pairs = fluid.neighbours;
    const FluidParameters& f = fluid.parameters;
    const WallPressureForce push;
    const SolidBackstop stop{f.spacing, f.mass / (2 * dt)};
    clear(particles, {0, particles.size()}, Fields<Force>{});
    std::visit(
        [&](const auto& diffusion) {
            clear(particles, particles.fluid(),
                  typename std::remove_cvref_t<decltype(diffusion)>::Writes{});
            sweep(particles, pairs.fluid_fluid, fluid.records, fluid.kernel, PressureForce{},
                  diffusion);
        },
        fluid.effects.diffusion);
    sweep(particles, pairs.fluid_solid, fluid.records, fluid.kernel, push, stop);
    sweep(particles, pairs.solid_fluid, fluid.records, fluid.kernel, push, stop);
    sweep(particles, pairs.body_solid, fluid.records, fluid.kernel, push);
    sweep(particles, pairs.wall_body, fluid.records, fluid.kernel, push);
}

void kick(Fluid& fluid, real dt)
{
    Particles& particles = fluid.particles;
    const FluidParameters& f = fluid.parameters;
    const auto v = particles[field::velocity];
    const auto F = particles[field::force];
    const Rows rows = particles.fluid();
    const real dt_m = dt / f.mass;
    const Vec3 g = dt * f.gravity;
    if (!particles.has(field::viscous_force)) {
        parallel_for(rows.begin, rows.end, [&](Index i) { v[at(i)] += dt_m * F[at(i)] + g; });
        return;
    }
    const auto F_visc = particles[field::viscous_force];
    parallel_for(rows.begin, rows.end,
                 [&](Index i) { v[at(i)] += dt_m * (F[at(i)] + F_visc[at(i)]) + g; });
}

void update_rates(Fluid& fluid)
{
    Particles& particles = fluid.particles;
    const FluidNeighbours& pairs = fluid.neighbours;
    const Rows rows = particles.fluid();
    fluid.records.load(particles, Fields<Velocity>{});
    clear(particles, rows, Continuity::Writes{});
    std::visit(
        [&](const auto& viscosity) {
            clear(particles, rows, typename std::remove_cvref_t<decltype(viscosity)>::Writes{});
            sweep(particles, pairs.fluid_fluid, fluid.records, fluid.kernel, Continuity{},
                  viscosity);
        },
        fluid.effects.viscosity);
    sweep(particles, pairs.fluid_solid, fluid.records, fluid.kernel, Continuity{});

    const auto rho = particles[field::density];
    const auto rate = particles[field::density_rate];
    if (!particles.has(field::diffusion_rate)) {
        parallel_for(rows.begin, rows.end, [&](Index i) { rate[at(i)] *= rho[at(i)]; });
        return;
    }
    const auto diffusion = particles[field::diffusion_rate];
    parallel_for(rows.begin, rows.end,
                 [&](Index i) { rate[at(i)] = rho[at(i)] * rate[at(i)] + diffusion[at(i)]; });
}

namespace {

// The largest of f over the fluid rows, NaN if any is NaN: a comparison that fails keeps the
// culprit.
real worst(const Particles& particles, const auto& f)
{
    const Rows rows = particles.fluid();
    return reduce(rows.begin, rows.end, real(0), f,
                  [](real a, real b) { return b <= a ? a : (a <= b ? b : a + b); });
}

} // namespace

real top_speed(const Fluid& fluid)
{
    const auto v = fluid.particles[field::velocity];
    return std::sqrt(worst(fluid.particles, [&](Index i) { return v[at(i)].squaredNorm(); }));
}

real top_acceleration(const Fluid& fluid)
{
    const auto F = fluid.particles[field::force];
    const Vec3 weight = fluid.parameters.mass * fluid.parameters.gravity;
    const real squared =
        worst(fluid.particles, [&](Index i) { return (F[at(i)] + weight).squaredNorm(); });
    return std::sqrt(squared) / fluid.parameters.mass;
}

real effective_viscosity(const Fluid& fluid)
{
    const auto* viscosity = std::get_if<Viscosity>(&fluid.effects.viscosity);
    return viscosity != nullptr ? viscosity->kappa / laminar_kappa(1, fluid.parameters.dimensions)
                                : 0;
}

std::vector<TimeLimit> fluid_limits(const Fluid& fluid)
{
    return fluid_limits(fluid.parameters, top_speed(fluid), top_acceleration(fluid),
                        effective_viscosity(fluid));
}

} // namespace hyoryu
