// SPDX-License-Identifier: MIT
#include "hyoryu/fluid/fluid.hpp"

#include "sweeps.hpp"

#include "hyoryu/core/error.hpp"

#include <cmath>

namespace hyoryu {

FluidTerms terms_of(const Fluid& fluid, real dt)
{
    const FluidParameters& f = fluid.parameters;
    FluidTerms terms{
        {f.eos, f.gravity}, {f.spacing, dt > 0 ? f.mass / (2 * dt) : 0}, fluid.effects, {}};
    if (const auto* collision = held<ParticleCollision>(fluid.effects.collision)) {
        terms.collision = collision->term(f.spacing, f.mass, dt);
    }
    return terms;
}

bool sticks_to_solids(const Fluid& fluid)
{
    return held<NoSlip>(fluid.effects.slip) != nullptr;
}

real stand_in_mass(const Fluid& fluid, std::int32_t owner)
{
    return owner >= 0 ? fluid.body_particle_mass[at(owner)] : fluid.parameters.mass;
}

namespace {

// An effect that a scene asks for is never left out in silence.
void expect_built(const FluidEffects& effects)
{
    const auto look = []<class Effect>(const Effect&) {
        if constexpr (!is_built<Effect>) {
            throw CaseError(std::string(Effect::name) + " is not part of this build",
                            "configure it without HYORYU_WITHOUT");
        }
    };
    std::visit(look, effects.diffusion);
    std::visit(look, effects.viscosity);
    std::visit(look, effects.shifting);
    std::visit(look, effects.slip);
    std::visit(look, effects.collision);
    std::visit(look, effects.cavitation);
}

} // namespace

void allocate(Fluid& fluid, Index fluid_count, Index wall_count, Index body_count)
{
    expect_built(fluid.effects);
    if (fluid.parameters.precision == Precision::double_precision) {
        fluid.pair_data.emplace<PairData<double>>();
    }
    using Core = Fields<Position, Velocity, Density, DensityRate, Volume, Pressure, Force>;
    std::visit(
        [&](const auto&... effect) {
            using Own = Union<Core, typename std::remove_cvref_t<decltype(effect)>::Writes...>;
            fluid.particles.allocate(Own{}, fluid_count, wall_count, body_count);
        },
        fluid.effects.diffusion, fluid.effects.viscosity, fluid.effects.shifting,
        fluid.effects.cavitation);
    if (wall_count + body_count > 0) {
        fluid.particles.add(
            Union<WallExtrapolation::Writes, SolidContinuity::Writes, Fields<Gap>>{});
    }
    if (sticks_to_solids(fluid) && wall_count + body_count > 0) {
        fluid.particles.add(Union<NoSlip::Writes, Fields<Depth>>{});
    }
    if (held<EddyViscosity>(fluid.effects.viscosity) != nullptr) {
        fluid.particles.add(Union<StrainRate::Writes, Fields<TurbulentViscosity>>{});
    }
    if (held<RenormalisedDiffusion>(fluid.effects.diffusion) != nullptr) {
        fluid.particles.add(DensityGradient::Writes{});
    }
    if (fluid.parameters.formulation == FormulationKind::mps) {
        fluid.particles.add(MpsGradient::Writes{});
    }
}

namespace {

// Leaves to the gap what solids would stretch of the fluid in dt, see fluid/parting.
void part_from_solids(Fluid& fluid, real dt)
{
    Particles& particles = fluid.particles;
    const auto rho = particles[field::density];
    const auto rate = particles[field::solid_rate];
    const auto gap = particles[field::gap];
    const real rho0 = fluid.parameters.eos.rho0;
    const Rows rows = particles.fluid();
    parallel_for(rows.begin, rows.end, [&](Index i) {
        const real kept = to_gap(gap[at(i)], dt * rate[at(i)], rho0 - rho[at(i)]);
        gap[at(i)] += kept;
        rho[at(i)] += kept;
    });
}

void open_cavities(Particles& particles, const Cavitation& cavitation)
{
    const auto rho = particles[field::density];
    const auto cavity = particles[field::cavity];
    const Rows rows = particles.fluid();
    parallel_for(rows.begin, rows.end,
                 [&](Index i) { cavitation.divide(rho[at(i)], cavity[at(i)]); });
}

} // namespace

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
    if (particles.has(field::gap)) {
        part_from_solids(fluid, dt);
    }
    if (const auto* cavitation = held<Cavitation>(fluid.effects.cavitation)) {
        open_cavities(particles, *cavitation);
    }
}

void update_pressure(Fluid& fluid)
{
    Particles& particles = fluid.particles;
    const FluidParameters& f = fluid.parameters;
    FluidNeighbours& n = fluid.neighbours;
    const auto rho = particles[field::density];
    const auto p = particles[field::pressure];
    const auto V = particles[field::volume];
    const Rows rows = particles.fluid();
    parallel_for(rows.begin, rows.end, [&](Index i) {
        p[at(i)] = f.eos.pressure(rho[at(i)]);
        V[at(i)] = f.mass / rho[at(i)];
    });
    load(fluid, n.fluid, Stored{});
    if (particles.solid().size() == 0) {
        return;
    }
    load_solids(fluid, Stored{});
    for_wet_solids(fluid, [&](std::size_t i) {
        particles[field::shepard_sum][i] = 0;
        p[i] = 0;
    });
    const FluidTerms terms = terms_of(fluid, 0);
    run(fluid, n.wall_fluid, n.wall, terms, [](const auto& loops) { return loops.extrapolation; });
    run(fluid, n.body_fluid, n.body, terms, [](const auto& loops) { return loops.extrapolation; });
    const auto shepard = particles[field::shepard_sum];
    const auto owner = particles.owner();
    for_wet_solids(fluid, [&](std::size_t i) {
        const real p_w = shepard[i] > 0 ? positive(p[i] / shepard[i]) : 0;
        p[i] = p_w;
        rho[i] = f.eos.density(p_w);
        V[i] = stand_in_mass(fluid, owner[i]) / rho[i];
    });
    load_solids(fluid, Fields<Volume, Pressure>{});
}

namespace {

// Forces of solids on each other in thin films, less what is left to joints: with the volumes of
// the particles, both sides of a pair shrink alike.
void add_film_forces(Fluid& fluid, const FluidTerms& terms)
{
    const FluidNeighbours& n = fluid.neighbours;
    const bool shared = !fluid.film_share.empty();
    if (shared) {
        const auto V = std::as_const(fluid.particles)[field::volume];
        const Index first = fluid.particles.body().begin;
        std::visit(
            [&](auto& data) {
                data.records.lend(n.body, field::volume, [&](std::size_t i) {
                    return V[i] * fluid.film_share[i - at(first)];
                });
            },
            fluid.pair_data);
    }
    run(fluid, n.body_solid, n.body, terms, [](const auto& loops) { return loops.film_forces; });
    run(fluid, n.wall_body, n.wall, terms, [](const auto& loops) { return loops.film_forces; });
    if (shared) {
        load(fluid, n.body, Fields<Volume>{});
    }
}

// Forces between fluid and solids, and of solids in thin films. Fluid that has parted from them
// shows them no pressure.
void add_solid_forces(Fluid& fluid, const FluidTerms& terms)
{
    const Particles& particles = fluid.particles;
    const FluidNeighbours& n = fluid.neighbours;
    const auto p = particles[field::pressure];
    const auto gap = particles[field::gap];
    std::visit(
        [&](auto& data) {
            data.records.lend(n.fluid, field::pressure,
                              [&](std::size_t i) { return gap[i] > 0 ? 0 : p[i]; });
        },
        fluid.pair_data);
    run(fluid, n.fluid_solid, n.fluid, terms, [](const auto& loops) { return loops.solid_forces; });
    run(fluid, n.wall_fluid, n.wall, terms, [](const auto& loops) { return loops.solid_loads; });
    run(fluid, n.body_fluid, n.body, terms, [](const auto& loops) { return loops.solid_loads; });
    load(fluid, n.fluid, Fields<Pressure>{});
    add_film_forces(fluid, terms);
}

} // namespace

void update_forces(Fluid& fluid, real dt)
{
    Particles& particles = fluid.particles;
    const FluidNeighbours& n = fluid.neighbours;
    const FluidTerms terms = terms_of(fluid, dt);
    const bool mps = fluid.parameters.formulation == FormulationKind::mps;
    clear(particles, particles.fluid(), Fields<Force>{});
    for_wet_solids(fluid, [&](std::size_t i) { particles[field::force][i].setZero(); });
    if (mps) {
        clear(particles, particles.fluid(), MpsGradient::Writes{});
    }
    if (particles.has(field::diffusion_rate)) {
        clear(particles, particles.fluid(), Fields<DiffusionRate>{});
    }
    run(fluid, n.fluid_fluid, n.fluid, terms, [](const auto& loops) { return loops.fluid_forces; });
    if (particles.solid().size() > 0) {
        add_solid_forces(fluid, terms);
    }
    if (held<ParticleCollision>(fluid.effects.collision) != nullptr) {
        run(fluid, n.fluid_fluid, n.fluid, terms,
            [](const auto& loops) { return loops.collision; });
    }
    if (mps) {
        add_corrected_pressure(fluid.parameters, particles);
    }
    if (held<RenormalisedDiffusion>(fluid.effects.diffusion) != nullptr) {
        add_renormalised_diffusion(fluid);
    }
}

void kick(Fluid& fluid, real dt)
{
    Particles& particles = fluid.particles;
    const FluidParameters& f = fluid.parameters;
    const auto v = particles[field::velocity];
    const auto F = particles[field::force];
    const Rows rows = particles.fluid();
    const real dt_m = dt / f.mass;
    const Vec3 g = dt * (f.gravity + f.drive);
    fluid.lost.momentum += dt * fluid.lost.force;
    fluid.lost.force.setZero();
    if (!particles.has(field::viscous_force)) {
        parallel_for(rows.begin, rows.end, [&](Index i) { v[at(i)] += dt_m * F[at(i)] + g; });
        return;
    }
    const auto F_visc = particles[field::viscous_force];
    parallel_for(rows.begin, rows.end,
                 [&](Index i) { v[at(i)] += dt_m * (F[at(i)] + F_visc[at(i)]) + g; });
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
    const Vec3 weight = fluid.parameters.mass * (fluid.parameters.gravity + fluid.parameters.drive);
    const real squared =
        worst(fluid.particles, [&](Index i) { return (F[at(i)] + weight).squaredNorm(); });
    return std::sqrt(squared) / fluid.parameters.mass;
}

real effective_viscosity(const Fluid& fluid)
{
    const real unit = laminar_kappa(1, fluid.parameters.dimensions);
    if (const auto* viscosity = held<Viscosity>(fluid.effects.viscosity)) {
        return viscosity->kappa / unit;
    }
    if (const auto* morris = held<MorrisViscosity>(fluid.effects.viscosity)) {
        return morris->mu / fluid.parameters.eos.rho0;
    }
    const auto* eddies = held<EddyViscosity>(fluid.effects.viscosity);
    if (eddies == nullptr) {
        return 0;
    }
    if (!fluid.particles.has(field::turbulent_viscosity)) {
        return eddies->kappa / unit;
    }
    const auto nu = fluid.particles[field::turbulent_viscosity];
    return eddies->kappa / unit + worst(fluid.particles, [&](Index i) { return nu[at(i)]; });
}

void shift(Fluid& fluid, real dt)
{
    const auto* shifting = held<Shifting>(fluid.effects.shifting);
    if (shifting == nullptr) {
        return;
    }
    constexpr real most_spacings = 0.05;
    Particles& particles = fluid.particles;
    const FluidParameters& f = fluid.parameters;
    const FluidNeighbours& n = fluid.neighbours;
    const Rows rows = particles.fluid();
    const FluidTerms terms = terms_of(fluid, dt);
    const real scale = shifting->coefficient * f.h * top_speed(fluid) * dt;
    clear(particles, rows, Shifting::Writes{});
    run(fluid, n.fluid_fluid, n.fluid, terms, [](const auto& loops) { return loops.shifting; });
    run(fluid, n.fluid_solid, n.fluid, terms, [](const auto& loops) { return loops.shifting; });
    const auto x = particles[field::position];
    const auto S = particles[field::shift_gradient];
    parallel_for(rows.begin, rows.end, [&](Index i) {
        const real way = scale * S[at(i)].norm();
        const real most = most_spacings * f.spacing;
        x[at(i)] -= (way > most ? most / way : 1) * scale * S[at(i)];
    });
}

std::array<TimeLimit, 3> fluid_limits(const Fluid& fluid)
{
    return fluid_limits(fluid.parameters, top_speed(fluid), top_acceleration(fluid),
                        effective_viscosity(fluid));
}

} // namespace hyoryu
