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

/// Copies fields of the fluid particles to the records of the pair loops.
void load_fluid(Fluid& fluid, const auto& fields)
{
    std::visit(
        [&](auto& data) {
            data.records.load(fluid.particles.fluid, fluid.neighbours.fluid, fields);
        },
        fluid.pair_data);
}

/// The same for the particles of bodies.
void load_bodies(Fluid& fluid, const auto& fields)
{
    std::visit(
        [&](auto& data) { data.records.load(fluid.particles.body, fluid.neighbours.body, fields); },
        fluid.pair_data);
}

/// The same for the solid particles that fluid or a body may be near.
void load_solids(Fluid& fluid, const auto& fields)
{
    const FluidNeighbours& n = fluid.neighbours;
    std::visit(
        [&](auto& data) { data.records.load(fluid.particles.wall, n.wall, n.wet_walls, fields); },
        fluid.pair_data);
    load_bodies(fluid, fields);
}

/// For the walls that fluid or a body may be near and for the bodies: `of_store(store)` is called
/// for each store and gives what is called with each row. Dry walls cost nothing.
void for_wet_solids(Fluid& fluid, const auto& of_store)
{
    const FluidNeighbours& n = fluid.neighbours;
    const auto of_wall = of_store(fluid.particles.wall);
    parallel_blocks(0, static_cast<Index>(n.wet_walls.size()), [&](Index k) {
        const auto tile = at(n.wet_walls[at(k)]);
        for (std::int32_t slot = n.wall.start[tile]; slot < n.wall.start[tile + 1]; ++slot) {
            of_wall(n.wall.row[at(slot)]);
        }
    });
    const auto of_body = of_store(fluid.particles.body);
    parallel_for(0, fluid.particles.body.size(), of_body);
}

/// Sets the listed columns of those particles to zero.
template <class List>
void clear_wet_solids(Fluid& fluid, List fields)
{
    for_each(fields, [&](auto field) {
        for_wet_solids(fluid, [&](Store& solids) {
            return [column = solids[field]](Index i) {
                if constexpr (width<decltype(field)> == 3) {
                    column[i].setZero();
                } else {
                    column[i] = 0;
                }
            };
        });
    });
}

/// f(formulation, kernel of its pairs).
auto with_formulation(const Fluid& fluid, const auto& f)
{
    return fluid.parameters.formulation == FormulationKind::mps ? f(Mps{}, fluid.mps_kernel)
                                                                : f(Sph{}, fluid.kernel);
}

/// The particles that a loop writes: their store and their places.
struct Destination {
    Store& store;
    const Tiles& tiles;
};
inline Destination to_fluid(Fluid& fluid)
{
    return {fluid.particles.fluid, fluid.neighbours.fluid};
}
inline Destination to_walls(Fluid& fluid)
{
    return {fluid.particles.wall, fluid.neighbours.wall};
}
inline Destination to_bodies(Fluid& fluid)
{
    return {fluid.particles.body, fluid.neighbours.body};
}

/// Runs the loop of a pass over all blocks of a list. The pass must be part of this build: passes
/// of effects that are left out have no loop, and nothing that holds such an effect can be made.
template <class Pass>
void run(Fluid& fluid, const PairList& pairs, const Destination& to, const FluidTerms& terms)
{
    const auto sweep = [&]<class Real, class Formulation>(PairData<Real>& data, Formulation,
                                                          const auto& kernel) {
        using Loops = PairLoops<Real, Formulation>;
        constexpr auto pass = static_cast<std::size_t>(pass_index<Pass, AllPasses>);
        const auto loop = std::get<Loops>(fluid_loops(fluid.instruction_set)).loop[pass];
        const typename Loops::View view{pairs.blocks().data(),
                                        data.records.data(),
                                        to.store.pointers(),
                                        to.tiles.row.data(),
                                        to.tiles.first_slot,
                                        to.tiles.lattice.edge,
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
