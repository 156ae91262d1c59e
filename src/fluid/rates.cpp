// SPDX-License-Identifier: MIT
// The rates that depend on velocities: continuity, viscosity, friction at solids, turbulence.
#include "hyoryu/fluid/fluid.hpp"

#include "sharing.hpp"
#include "sweeps.hpp"

namespace hyoryu {

namespace {

// Computes the mirrored velocity of solid particles for the viscosity, in the column of the
// velocity sums.
void mirror_velocities(Fluid& fluid)
{
    const FluidNeighbours& n = fluid.neighbours;
    clear_wet_solids(fluid, NoSlip::Writes{});
    const FluidTerms terms = terms_of(fluid, 0);
    run<NoSlip::Mirror>(fluid, n.wall_fluid, to_walls(fluid), terms);
    run<NoSlip::Mirror>(fluid, n.body_fluid, to_bodies(fluid), terms);
    for_wet_solids(fluid, [&](Store& solids) {
        return [u = solids[field::velocity], v_sum = solids[field::velocity_sum],
                r_sum = solids[field::offset_sum], shepard = solids[field::shepard_sum],
                depth = solids[field::depth], dp = fluid.parameters.spacing](Index i) {
            v_sum[i] = shepard[i] > 0 ? mirrored_velocity(u[i], v_sum[i] / shepard[i],
                                                          r_sum[i] / shepard[i], depth[i], dp)
                                      : u[i];
        };
    });
    share_solids(fluid, Fields<VelocitySum>{});
}

enum class SolidVelocity { own, mirrored };

void show_velocities(Fluid& fluid, SolidVelocity which)
{
    load_solids(fluid, Fields<Velocity>{});
    if (which == SolidVelocity::own) {
        return;
    }
    std::visit(
        [&](auto& data) {
            const auto show = [&](const Store& store, const Tiles& tiles) {
                const auto shown = store[field::velocity_sum];
                data.records().show(tiles, field::velocity,
                                    [&](std::size_t row) { return shown[row]; });
            };
            show(fluid.particles.wall, fluid.neighbours.wall);
            show(fluid.particles.body, fluid.neighbours.body);
            if (const Ghosts* const g = fluid.ghosts.get()) {
                show(g->particles.wall, g->wall.tiles);
                show(g->particles.body, g->body.tiles);
            }
        },
        fluid.pair_data);
}

// Calls f with the mirrored velocities in the records of solids, then restores their own
// velocities.
void with_mirrored_velocities(Fluid& fluid, const auto& f)
{
    show_velocities(fluid, SolidVelocity::mirrored);
    then_restore(f, [&] { show_velocities(fluid, SolidVelocity::own); });
}

// nu_t of every fluid particle.
void update_turbulence(Fluid& fluid, const EddyViscosity& eddies, bool sticks)
{
    Store& store = fluid.particles.fluid;
    const FluidNeighbours& n = fluid.neighbours;
    const FluidTerms terms = terms_of(fluid, 0);
    clear(store, StrainRate::Writes{});
    run<PassOf<StrainRate>>(fluid, n.fluid_fluid, to_fluid(fluid), terms);
    if (sticks) {
        with_mirrored_velocities(
            fluid, [&] { run<PassOf<StrainRate>>(fluid, n.fluid_solid, to_fluid(fluid), terms); });
    }
    const auto strain = store[field::strain];
    const auto mixed = store[field::mixed_strain];
    const auto nu = store[field::turbulent_viscosity];
    parallel_for(0, store.size(),
                 [&](Index i) { nu[i] = eddy_viscosity(strain[i], mixed[i], eddies.length); });
    share_fluid(fluid, Fields<TurbulentViscosity>{});
}

// Viscous forces between the fluid and the solids to which it sticks.
void add_friction(Fluid& fluid)
{
    const FluidNeighbours& n = fluid.neighbours;
    const FluidTerms terms = terms_of(fluid, 0);
    with_mirrored_velocities(fluid, [&] {
        for_solids(fluid.particles, [](Store& solids) { clear(solids, Fields<ViscousForce>{}); });
        run<NoSlip::Friction>(fluid, n.fluid_solid, to_fluid(fluid), terms);
        run<NoSlip::Friction>(fluid, n.wall_fluid, to_walls(fluid), terms);
        run<NoSlip::Friction>(fluid, n.body_fluid, to_bodies(fluid), terms);
    });
    replicate_body_friction(fluid);
}

// Sets the density rate due to solids.
void update_solid_rates(Fluid& fluid)
{
    Store& store = fluid.particles.fluid;
    clear(store, SolidContinuity::Writes{});
    const bool paired = held<PairedWalls>(fluid.effects) != nullptr;
    if (paired) {
        clear(store, PairedWalls::Normal::Writes{});
    }
    run<pass::SolidRates>(fluid, fluid.neighbours.fluid_solid, to_fluid(fluid), terms_of(fluid, 0));
    const auto rho = store[field::density];
    const auto rate = store[field::solid_rate];
    parallel_for(0, store.size(), [&](Index i) { rate[i] *= rho[i]; });
    if (paired) {
        add_paired_rates(fluid);
    }
}

// Closes gaps that are too near to solids. It comes after the rates, since these must count the
// same pairs as the forces.
void close_gaps(Fluid& fluid)
{
    Store& store = fluid.particles.fluid;
    const FluidParameters& f = fluid.parameters;
    const real touching = sum_beside_plane(fluid.kernel, f.spacing, f.dimensions);
    const auto sum = store[field::shepard_sum];
    const auto gap = store[field::gap];
    parallel_for(0, store.size(),
                 [&](Index i) { gap[i] = std::min(gap[i], f.mass * positive(touching - sum[i])); });
}

// Adds a part of the density rate to it, if there is one.
void add_part(Store& store, auto part)
{
    if (store.has(part)) {
        const auto rate = store[field::density_rate];
        const auto values = store[part];
        parallel_for(0, store.size(), [&](Index i) { rate[i] += values[i]; });
    }
}

// Pairs of the fluid: those of this rank while the velocities of ghosts are on their way.
void run_fluid_rates(Fluid& fluid, const FluidTerms& terms)
{
    const PairList& pairs = fluid.neighbours.fluid_fluid;
    if (!fluid.ghosts) {
        run<pass::FluidRates>(fluid, pairs, to_fluid(fluid), terms);
        return;
    }
    const Index inner = fluid.ghosts->inner;
    run<pass::FluidRates>(fluid, {{pairs, to_fluid(fluid), Rows{0, inner}}}, terms);
    receive_velocities(fluid);
    const Rows outer{inner, std::ssize(pairs.blocks())};
    run<pass::FluidRates>(fluid, {{pairs, to_fluid(fluid), outer}}, terms);
}

} // namespace

void update_rates(Fluid& fluid)
{
    Store& store = fluid.particles.fluid;
    const FluidTerms terms = terms_of(fluid, 0);
    send_velocities(fluid);
    load_own_fluid(fluid, Fields<Velocity>{});
    load_own_solids(fluid, Fields<Velocity>{});
    clear(store, Union<Continuity::Writes, StageWrites<stage::Rates>>{});
    const bool corrects = held<CorrectedGradient>(fluid.effects) != nullptr;
    if (corrects) {
        clear(store, Union<GradientMoments::Writes, CorrectedContinuity::Writes>{});
    }
    const bool sticks = sticks_to_solids(fluid) && has_solids(fluid);
    const bool pairs = held<PairedWalls>(fluid.effects) != nullptr && has_solids(fluid);
    if (sticks || pairs || held<EddyViscosity>(fluid.effects) != nullptr) {
        receive_velocities(fluid);
    }
    if (sticks) {
        mirror_velocities(fluid);
    }
    if (const auto* eddies = held<EddyViscosity>(fluid.effects)) {
        update_turbulence(fluid, *eddies, sticks);
    }
    run_fluid_rates(fluid, terms);
    if (sticks) {
        add_friction(fluid);
    }
    const auto rho = store[field::density];
    const auto rate = store[field::density_rate];
    parallel_for(0, store.size(), [&](Index i) { rate[i] *= rho[i]; });
    if (corrects) {
        add_corrections(fluid.parameters, store);
    }
    if (store.has(field::solid_rate)) {
        update_solid_rates(fluid);
        close_gaps(fluid);
        add_part(store, field::solid_rate);
    }
    add_part(store, field::diffusion_rate);
    if (corrects) {
        update_corrections(fluid.parameters, store);
    }
}

} // namespace hyoryu
