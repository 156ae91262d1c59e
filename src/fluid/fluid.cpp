// SPDX-License-Identifier: MIT
#include "hyoryu/fluid/fluid.hpp"

#include "sharing.hpp"
#include "sweeps.hpp"

#include "hyoryu/core/error.hpp"

#include <cmath>

namespace hyoryu {

FluidTerms terms_of(const Fluid& fluid, real dt)
{
    const FluidParameters& f = fluid.parameters;
    FluidTerms terms{
        {f.eos, f.gravity}, {f.spacing, dt > 0 ? f.mass / (2 * dt) : 0}, fluid.effects, {}};
    if (const auto* collision = held<ParticleCollision>(fluid.effects)) {
        terms.collision = collision->term(f.spacing, f.mass, dt);
    }
    return terms;
}

bool sticks_to_solids(const Fluid& fluid)
{
    return held<NoSlip>(fluid.effects) != nullptr;
}

namespace {

// Reports an effect that the scene requests but this build does not contain.
void expect_built(const FluidEffects& effects)
{
    const auto look = []<class Effect>(const Effect*) {
        if constexpr (!is_built<Effect>) {
            throw CaseError(std::string(Effect::name) + " is not part of this build",
                            "configure it without HYORYU_WITHOUT");
        }
    };
    for_each(AllSlots{}, [&](auto slot) {
        std::visit([&](const auto& effect) { look(&effect); }, effects[slot]);
    });
}

// Adds the columns that an effect needs, to solids only if the effect acts on them.
template <class Effect>
void add_columns_of(Fluid& fluid, const Effect&)
{
    constexpr bool needs_solids = requires
    {
        Effect::needs_solids;
    };
    constexpr bool has_columns = requires
    {
        typename Effect::Columns;
    };
    const auto add = [&](auto columns) {
        if constexpr (!needs_solids) {
            fluid.particles.fluid.add(columns);
        } else if (has_solids(fluid)) {
            add_columns(fluid.particles, columns);
        }
    };
    if constexpr (has_columns) {
        add(typename Effect::Columns{});
    } else {
        add(typename Effect::Writes{});
    }
}

} // namespace

bool has_solids(const Fluid& fluid)
{
    return fluid.particles.solids() + fluid.fixed_walls.count > 0;
}

void allocate(Fluid& fluid, Index fluid_count, Index wall_count, Index body_count)
{
    expect_built(fluid.effects);
    if (fluid.parameters.precision == Precision::double_precision) {
        fluid.pair_data.emplace<PairData<double>>();
    }
    reset(fluid.particles, fluid_count, wall_count, body_count);
    add_columns(fluid.particles,
                Fields<Position, Velocity, Density, DensityRate, Volume, Pressure, Force>{});
    for_each_effect(fluid.effects, [&](const auto& effect) { add_columns_of(fluid, effect); });
    if (has_solids(fluid)) {
        add_columns(fluid.particles, Union<WallExtrapolation::Writes, SolidContinuity::Writes,
                                           Fields<Gap, DisplacedMass>>{});
        for_solids(fluid.particles, [&](Store& store) {
            std::ranges::fill(store[field::displaced_mass], mass_of_cube(fluid.parameters));
        });
    }
}

namespace {

// Adds the stretching of the fluid by solids within dt to the gap instead, see fluid/parting.
void part_from_solids(Fluid& fluid, real dt)
{
    Store& store = fluid.particles.fluid;
    const auto rho = store[field::density];
    const auto rate = store[field::solid_rate];
    const auto gap = store[field::gap];
    const real rho0 = fluid.parameters.eos.rho0;
    parallel_for(0, store.size(), [&](Index i) {
        const real kept = to_gap(gap[i], dt * rate[i], rho0 - rho[i]);
        gap[i] += kept;
        rho[i] += kept;
    });
}

} // namespace

void drift(Fluid& fluid, real dt)
{
    Store& store = fluid.particles.fluid;
    const auto x = store[field::position];
    const auto v = store[field::velocity];
    const auto rho = store[field::density];
    const auto rate = store[field::density_rate];
    parallel_for(0, store.size(), [&](Index i) {
        rho[i] += dt * rate[i];
        x[i] += dt * v[i];
    });
    if (store.has(field::correction)) { // the density due to the correction of the divergence
        const auto made = store[field::correction];
        const auto correction_rate = store[field::correction_rate];
        parallel_for(0, store.size(), [&](Index i) { made[i] += dt * correction_rate[i]; });
    }
    if (store.has(field::gap)) {
        part_from_solids(fluid, dt);
    }
    if (const auto* cavitation = held<Cavitation>(fluid.effects)) {
        const auto cavity = store[field::cavity];
        parallel_for(0, store.size(), [&](Index i) { cavitation->divide(rho[i], cavity[i]); });
    }
}

namespace {

// Extrapolates the fluid pressure to solid particles and sets their density and volume.
void extrapolate_pressure(Fluid& fluid)
{
    const FluidNeighbours& n = fluid.neighbours;
    load_solids(fluid, Stored{});
    clear_wet_solids(fluid, Fields<ShepardSum, Pressure>{});
    const FluidTerms terms = terms_of(fluid, 0);
    run<pass::Extrapolation>(fluid, n.wall_fluid, to_walls(fluid), terms);
    run<pass::Extrapolation>(fluid, n.body_fluid, to_bodies(fluid), terms);
    for_wet_solids(fluid, [&](Store& solids) {
        return
            [eos = fluid.parameters.eos, p_w = solids[field::pressure],
             rho_w = solids[field::density], V_w = solids[field::volume],
             shepard = solids[field::shepard_sum], mass = solids[field::displaced_mass]](Index i) {
                p_w[i] = shepard[i] > 0 ? positive(p_w[i] / shepard[i]) : 0;
                rho_w[i] = eos.density(p_w[i]);
                V_w[i] = mass[i] / rho_w[i];
            };
    });
    send_pressures(fluid);
    load_own_solids(fluid, Fields<Volume, Pressure>{});
}

// p and V from rho.
void apply_equation_of_state(const FluidParameters& f, Store& store)
{
    const auto rho = store[field::density];
    const auto p = store[field::pressure];
    const auto V = store[field::volume];
    parallel_for(0, store.size(), [&](Index i) {
        p[i] = f.eos.pressure(rho[i]);
        V[i] = f.mass / rho[i];
    });
}

} // namespace

void update_pressure(Fluid& fluid)
{
    apply_equation_of_state(fluid.parameters, fluid.particles.fluid);
    if (fluid.ghosts) {
        apply_equation_of_state(fluid.parameters, fluid.ghosts->particles.fluid);
    }
    load_fluid(fluid, Stored{});
    if (has_solids(fluid)) {
        extrapolate_pressure(fluid);
    }
}

namespace {

// Forces between solids in thin films. For particles behind a joint the part along its normal is
// removed, as the joint replaces it; the opposite side gets it back, so that momentum is conserved.
void add_film_forces(Fluid& fluid, const FluidTerms& terms)
{
    const FluidNeighbours& n = fluid.neighbours;
    const auto F = fluid.particles.body[field::force];
    for (FilmCut& cut : fluid.film_cuts) {
        cut.removed = -F[cut.row];
    }
    run<pass::FilmForces>(fluid, n.body_solid, to_bodies(fluid), terms);
    run<pass::FilmForces>(fluid, n.wall_body, to_walls(fluid), terms);
    for (FilmCut& cut : fluid.film_cuts) {
        const Vec3 film = cut.removed + F[cut.row];
        cut.removed = cut.part * cut.normal.dot(film) * cut.normal;
    }
    for (const FilmCut& cut : fluid.film_cuts) {
        F[cut.row] -= cut.removed;
    }
}

// Forces between fluid and solids, and between solids in thin films. Fluid with a gap exerts no
// pressure on solids.
void add_solid_forces(Fluid& fluid, const FluidTerms& terms)
{
    const FluidNeighbours& n = fluid.neighbours;
    with_touching_pressures(fluid, [&] {
        run<pass::SolidForces>(fluid,
                               {{n.fluid_solid, to_fluid(fluid)},
                                {n.wall_fluid, to_walls(fluid)},
                                {n.body_fluid, to_bodies(fluid)}},
                               terms);
    });
    add_film_forces(fluid, terms);
}

} // namespace

void update_forces(Fluid& fluid, real dt)
{
    Store& store = fluid.particles.fluid;
    const FluidNeighbours& n = fluid.neighbours;
    const FluidTerms terms = terms_of(fluid, dt);
    clear(store, Union<Fields<Force>, StageWrites<stage::Forces>>{});
    clear_wet_solids(fluid, Fields<Force>{});
    run<pass::FluidForces>(fluid, n.fluid_fluid, to_fluid(fluid), terms);
    receive_pressures(fluid);
    if (has_solids(fluid)) {
        add_solid_forces(fluid, terms);
    }
    if (held<ParticleCollision>(fluid.effects) != nullptr) {
        run<ParticleCollision::Sum>(fluid, n.fluid_fluid, to_fluid(fluid), terms);
    }
    if (held<RenormalisedDiffusion>(fluid.effects) != nullptr) {
        add_renormalised_diffusion(fluid);
    }
}

void kick(Fluid& fluid, real dt)
{
    Store& store = fluid.particles.fluid;
    const FluidParameters& f = fluid.parameters;
    const auto v = store[field::velocity];
    const auto F = store[field::force];
    const real dt_m = dt / f.mass;
    const Vec3 g = dt * (f.gravity + f.drive);
    fluid.lost.momentum += dt * fluid.lost.force;
    fluid.lost.force.setZero();
    if (!store.has(field::viscous_force)) {
        parallel_for(0, store.size(), [&](Index i) { v[i] += dt_m * F[i] + g; });
        return;
    }
    const auto F_visc = store[field::viscous_force];
    parallel_for(0, store.size(), [&](Index i) { v[i] += dt_m * (F[i] + F_visc[i]) + g; });
}

namespace {

// The largest f over the fluid rows, NaN if any value is NaN: failed comparisons keep the NaN.
real worst(const Fluid& fluid, const auto& f)
{
    return reduce(0, fluid.particles.fluid.size(), real(0), f,
                  [](real a, real b) { return b <= a ? a : (a <= b ? b : a + b); });
}

} // namespace

real top_speed(const Fluid& fluid)
{
    const auto v = fluid.particles.fluid[field::velocity];
    return std::sqrt(worst(fluid, [&](Index i) { return v[i].squaredNorm(); }));
}

real top_acceleration(const Fluid& fluid)
{
    const auto F = fluid.particles.fluid[field::force];
    const Vec3 weight = fluid.parameters.mass * (fluid.parameters.gravity + fluid.parameters.drive);
    const real squared = worst(fluid, [&](Index i) { return (F[i] + weight).squaredNorm(); });
    return std::sqrt(squared) / fluid.parameters.mass;
}

real effective_viscosity(const Fluid& fluid)
{
    const real unit = laminar_kappa(1, fluid.parameters.dimensions);
    if (const auto* viscosity = held<Viscosity>(fluid.effects)) {
        return viscosity->kappa / unit;
    }
    if (const auto* morris = held<MorrisViscosity>(fluid.effects)) {
        return morris->mu / fluid.parameters.eos.rho0;
    }
    const auto* eddies = held<EddyViscosity>(fluid.effects);
    if (eddies == nullptr) {
        return 0;
    }
    if (!fluid.particles.fluid.has(field::turbulent_viscosity)) {
        return eddies->kappa / unit;
    }
    const auto nu = fluid.particles.fluid[field::turbulent_viscosity];
    return eddies->kappa / unit + worst(fluid, [&](Index i) { return nu[i]; });
}

} // namespace hyoryu
