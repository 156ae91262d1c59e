// SPDX-License-Identifier: MIT
// The rates that depend on velocities: continuity, viscosity, friction at solids, turbulence.
#include "hyoryu/fluid/fluid.hpp"

#include "sweeps.hpp"

namespace hyoryu {

namespace {

// What solid particles show to the viscosity, in the column of the velocity sums.
void mirror_velocities(Fluid& fluid)
{
    Particles& particles = fluid.particles;
    const FluidNeighbours& n = fluid.neighbours;
    const auto shepard = particles[field::shepard_sum];
    const auto v_sum = particles[field::velocity_sum];
    const auto r_sum = particles[field::offset_sum];
    for_wet_solids(fluid, [&](std::size_t i) {
        shepard[i] = 0;
        v_sum[i].setZero();
        r_sum[i].setZero();
    });
    const FluidTerms terms = terms_of(fluid, 0);
    run(fluid, n.wall_fluid, n.wall, terms, [](const auto& loops) { return loops.mirror; });
    run(fluid, n.body_fluid, n.body, terms, [](const auto& loops) { return loops.mirror; });
    const auto u = particles[field::velocity];
    const auto depth = particles[field::depth];
    for_wet_solids(fluid, [&](std::size_t i) {
        v_sum[i] = shepard[i] > 0
                       ? mirrored_velocity(u[i], v_sum[i] / shepard[i], r_sum[i] / shepard[i],
                                           depth[i], fluid.parameters.spacing)
                       : u[i];
    });
}

// Records of the solids lend a place to another column, or take their own field again.
template <Field From, Field To>
void lend_solids(Fluid& fluid, From from, To to)
{
    const FluidNeighbours& n = fluid.neighbours;
    std::visit(
        [&](auto& data) {
            data.records.lend(fluid.particles, n.wall, from, to);
            data.records.lend(fluid.particles, n.body, from, to);
        },
        fluid.pair_data);
}

// nu_t of every fluid particle, in its column and in the place of the pressure of the records.
void update_turbulence(Fluid& fluid, const EddyViscosity& eddies, bool sticks)
{
    Particles& particles = fluid.particles;
    const FluidNeighbours& n = fluid.neighbours;
    const FluidTerms terms = terms_of(fluid, 0);
    clear(particles, particles.fluid(), StrainRate::Writes{});
    run(fluid, n.fluid_fluid, n.fluid, terms, [](const auto& loops) { return loops.strain; });
    if (sticks) {
        lend_solids(fluid, field::velocity_sum, field::velocity);
        run(fluid, n.fluid_solid, n.fluid, terms, [](const auto& loops) { return loops.strain; });
        load_solids(fluid, Fields<Velocity>{});
    }
    const auto strain = particles[field::strain];
    const auto mixed = particles[field::mixed_strain];
    const auto nu = particles[field::turbulent_viscosity];
    const Rows rows = particles.fluid();
    parallel_for(rows.begin, rows.end, [&](Index i) {
        nu[at(i)] = eddy_viscosity(strain[at(i)], mixed[at(i)], eddies.length);
    });
    std::visit(
        [&](auto& data) {
            data.records.lend(particles, n.fluid, field::turbulent_viscosity, field::pressure);
        },
        fluid.pair_data);
    if (sticks) {
        lend_solids(fluid, field::turbulent_viscosity, field::pressure); // theirs stays zero
    }
}

// Viscous forces between the fluid and the solids to which it sticks.
void add_friction(Fluid& fluid)
{
    const FluidNeighbours& n = fluid.neighbours;
    const FluidTerms terms = terms_of(fluid, 0);
    lend_solids(fluid, field::velocity_sum, field::velocity);
    clear(fluid.particles, fluid.particles.solid(), Fields<ViscousForce>{});
    const auto friction = [](const auto& loops) { return loops.friction; };
    run(fluid, n.fluid_solid, n.fluid, terms, friction);
    run(fluid, n.wall_fluid, n.wall, terms, friction);
    run(fluid, n.body_fluid, n.body, terms, friction);
}

// The part of the density rate that solids make, and the end of gaps where there is no room for
// one.
void update_solid_rates(Fluid& fluid)
{
    Particles& particles = fluid.particles;
    const FluidNeighbours& n = fluid.neighbours;
    const FluidParameters& f = fluid.parameters;
    const Rows rows = particles.fluid();
    clear(particles, rows, SolidContinuity::Writes{});
    run(fluid, n.fluid_solid, n.fluid, terms_of(fluid, 0),
        [](const auto& loops) { return loops.solid_rates; });
    const real touching = with_formulation(fluid, [&](auto, const auto& kernel) {
        return sum_beside_plane(kernel, f.spacing, f.dimensions);
    });
    const auto rho = particles[field::density];
    const auto rate = particles[field::solid_rate];
    const auto sum = particles[field::shepard_sum];
    const auto gap = particles[field::gap];
    parallel_for(rows.begin, rows.end, [&](Index i) {
        rate[at(i)] *= rho[at(i)];
        gap[at(i)] = std::min(gap[at(i)], f.mass * positive(touching - sum[at(i)]));
    });
}

// rate += a part of it.
void add(const Particles& particles, Rows rows, auto part, std::span<real> rate)
{
    const auto values = particles[part];
    parallel_for(rows.begin, rows.end, [&](Index i) { rate[at(i)] += values[at(i)]; });
}

} // namespace

void update_rates(Fluid& fluid)
{
    Particles& particles = fluid.particles;
    const FluidNeighbours& n = fluid.neighbours;
    const Rows rows = particles.fluid();
    const FluidTerms terms = terms_of(fluid, 0);
    load(fluid, n.fluid, Fields<Velocity>{});
    load_solids(fluid, Fields<Velocity>{});
    clear(particles, rows, Continuity::Writes{});
    if (particles.has(field::viscous_force)) {
        clear(particles, rows, Fields<ViscousForce>{});
    }
    const bool sticks = sticks_to_solids(fluid) && particles.solid().size() > 0;
    if (sticks) {
        mirror_velocities(fluid);
    }
    if (const auto* eddies = held<EddyViscosity>(fluid.effects.viscosity)) {
        update_turbulence(fluid, *eddies, sticks);
    }
    run(fluid, n.fluid_fluid, n.fluid, terms, [](const auto& loops) { return loops.fluid_rates; });
    if (sticks) {
        add_friction(fluid);
    }
    const auto rho = particles[field::density];
    const auto rate = particles[field::density_rate];
    parallel_for(rows.begin, rows.end, [&](Index i) { rate[at(i)] *= rho[at(i)]; });
    if (particles.has(field::solid_rate)) {
        update_solid_rates(fluid);
        add(particles, rows, field::solid_rate, rate);
    }
    if (particles.has(field::diffusion_rate)) {
        add(particles, rows, field::diffusion_rate, rate);
    }
}

} // namespace hyoryu
