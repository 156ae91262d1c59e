// SPDX-License-Identifier: MIT
// How the stages of the fluid run the pair loops.
#pragma once

#include "hyoryu/fluid/fluid.hpp"

namespace hyoryu {

inline std::size_t at(Index row)
{
    return static_cast<std::size_t>(row);
}

/// The terms of a step of length dt; 0 for stages that do not depend on it.
FluidTerms terms_of(const Fluid& fluid, real dt);

/// D of the renormalised diffusion, from the pressures that the records hold; they lose velocities.
void add_renormalised_diffusion(Fluid& fluid);

/// Copies fields of the particles of some tiles to what the pair loops read.
void load(Fluid& fluid, const Tiles& tiles, const auto& fields)
{
    std::visit([&](auto& data) { data.records.load(fluid.particles, tiles, fields); },
               fluid.pair_data);
}

/// The same for the solid particles that fluid or a body may be near.
void load_solids(Fluid& fluid, const auto& fields)
{
    const FluidNeighbours& n = fluid.neighbours;
    std::visit(
        [&](auto& data) {
            data.records.load(fluid.particles, n.wall, n.wet_walls, fields);
            data.records.load(fluid.particles, n.body, fields);
        },
        fluid.pair_data);
}

/// Calls f for the rows of these particles; dry walls cost nothing.
void for_wet_solids(const Fluid& fluid, const auto& f)
{
    const FluidNeighbours& n = fluid.neighbours;
    parallel_blocks(0, static_cast<Index>(n.wet_walls.size()), [&](Index k) {
        const auto tile = at(n.wet_walls[at(k)]);
        for (std::int32_t slot = n.wall.start[tile]; slot < n.wall.start[tile + 1]; ++slot) {
            f(at(n.wall.row[at(slot)]));
        }
    });
    const Rows bodies = fluid.particles.body();
    parallel_for(bodies.begin, bodies.end, [&](Index i) { f(at(i)); });
}

/// f(formulation, kernel of its pairs).
auto with_formulation(const Fluid& fluid, const auto& f)
{
    return fluid.parameters.formulation == FormulationKind::mps ? f(Mps{}, fluid.mps_kernel)
                                                                : f(Sph{}, fluid.kernel);
}

/// Runs one of the pair loops over all blocks of a list; `which` names it.
void run(Fluid& fluid, const PairList& pairs, const Tiles& destination, const FluidTerms& terms,
         const auto& which)
{
    const auto sweep = [&]<class Real, class Formulation>(PairData<Real>& data, Formulation,
                                                          const auto& kernel) {
        using Loops = PairLoops<Real, Formulation>;
        const auto loop = which(std::get<Loops>(fluid_loops(fluid.instruction_set)));
        const typename Loops::View view{pairs.blocks().data(),
                                        data.records.data(),
                                        fluid.particles.pointers(),
                                        destination.row.data(),
                                        destination.first_slot,
                                        destination.lattice.edge,
                                        kernel};
        parallel_blocks(0, static_cast<Index>(pairs.blocks().size()), [&](Index block) {
            loop(view, block, data.local[at(worker())].data(), terms);
        });
    };
    with_formulation(fluid, [&](auto formulation, const auto& kernel) {
        std::visit([&](auto& data) { sweep(data, formulation, kernel); }, fluid.pair_data);
    });
}

} // namespace hyoryu
