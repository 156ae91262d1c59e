// SPDX-License-Identifier: MIT
#include "hyoryu/fluid/paired_walls.hpp"

#include "sharing.hpp"
#include "sweeps.hpp"

namespace hyoryu {

namespace {

// D/S of every solid particle with fluid before it.
void update_compressions(Fluid& fluid)
{
    const FluidNeighbours& n = fluid.neighbours;
    const FluidTerms terms = terms_of(fluid, 0);
    clear_wet_solids(fluid, PairedWalls::Writes{});
    with_touching_pressures(fluid, [&] {
        run<PairedWalls::Before>(
            fluid, {{n.wall_fluid, to_walls(fluid)}, {n.body_fluid, to_bodies(fluid)}}, terms);
    });
    for_wet_solids(fluid, [&](Store& solids) {
        return [D = solids[field::wall_compression], u = solids[field::velocity],
                v_sum = solids[field::velocity_sum], gradient = solids[field::gradient_sum],
                normal = solids[field::normal_sum], squares = solids[field::normal_squares],
                S = solids[field::shepard_sum]](Index i) {
            if (S[i] > 0) {
                D[i] = compression_before(D[i], u[i] - v_sum[i] / S[i], gradient[i],
                                          {normal[i], squares[i], S[i]}) /
                       S[i];
            }
        };
    });
    share_solids(fluid, Fields<WallCompression>{});
}

} // namespace

void add_paired_rates(Fluid& fluid)
{
    Store& store = fluid.particles.fluid;
    share_fluid(fluid, Fields<WallNormal>{});
    update_compressions(fluid);
    clear(store, PairedWalls::Rate::Writes{});
    run<PairedWalls::Rates>(fluid, fluid.neighbours.fluid_solid, to_fluid(fluid),
                            terms_of(fluid, 0));
    const auto rho = store[field::density];
    const auto V = store[field::volume];
    const auto paired = store[field::paired_rate];
    const auto rate = store[field::solid_rate];
    parallel_for(0, store.size(), [&](Index i) { rate[i] += rho[i] / V[i] * paired[i]; });
}

} // namespace hyoryu
