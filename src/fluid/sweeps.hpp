// SPDX-License-Identifier: MIT
// Functions by which the stages of the fluid run the pair loops.
#pragma once

#include "hyoryu/fluid/fluid.hpp"

#include <algorithm>
#include <initializer_list>
#include <optional>

namespace hyoryu {

/// The terms of a step of length dt; 0 for stages that do not depend on it.
FluidTerms terms_of(const Fluid& fluid, real dt);

/// D of the renormalised diffusion, from the pressures that the records hold.
void add_renormalised_diffusion(Fluid& fluid);

/// Copies fields of the fluid particles of this rank to the records of the pair loops.
void load_own_fluid(Fluid& fluid, const auto& fields)
{
    std::visit(
        [&](auto& data) {
            data.records().load(fluid.particles.fluid, fluid.neighbours.fluid, fields);
        },
        fluid.pair_data);
}

/// The same for the solid particles that fluid or a body may be near.
void load_own_solids(Fluid& fluid, const auto& fields)
{
    const FluidNeighbours& n = fluid.neighbours;
    std::visit(
        [&](auto& data) {
            data.records().load(fluid.particles.wall, n.wall, fields, n.wet_walls);
            data.records().load(fluid.particles.body, n.body, fields);
        },
        fluid.pair_data);
}

/// The same for ghosts.
void load_ghost_fluid(Fluid& fluid, const auto& fields)
{
    if (const Ghosts* const g = fluid.ghosts.get()) {
        std::visit(
            [&](auto& data) { data.records().load(g->particles.fluid, g->fluid.tiles, fields); },
            fluid.pair_data);
    }
}
void load_ghost_solids(Fluid& fluid, const auto& fields)
{
    if (const Ghosts* const g = fluid.ghosts.get()) {
        std::visit(
            [&](auto& data) {
                data.records().load(g->particles.wall, g->wall.tiles, fields);
                data.records().load(g->particles.body, g->body.tiles, fields);
            },
            fluid.pair_data);
    }
}

/// The same for all of a kind.
void load_fluid(Fluid& fluid, const auto& fields)
{
    load_own_fluid(fluid, fields);
    load_ghost_fluid(fluid, fields);
}
void load_solids(Fluid& fluid, const auto& fields)
{
    load_own_solids(fluid, fields);
    load_ghost_solids(fluid, fields);
}

/// Calls f, then `restore`, which is called if f throws, too.
void then_restore(const auto& f, const auto& restore)
{
    try {
        f();
    } catch (...) {
        restore();
        throw;
    }
    restore();
}

/// Calls f while the records of fluid with a gap, on which solids do not push, show zero pressure.
void with_touching_pressures(Fluid& fluid, const auto& f)
{
    const auto show = [](auto& data, const Store& store, const Tiles& tiles) {
        const auto p = store[field::pressure];
        const auto gap = store[field::gap];
        data.records().show(tiles, field::pressure,
                            [&](std::size_t i) { return gap[i] > 0 ? 0 : p[i]; });
    };
    std::visit(
        [&](auto& data) {
            show(data, fluid.particles.fluid, fluid.neighbours.fluid);
            if (const Ghosts* const g = fluid.ghosts.get()) {
                show(data, g->particles.fluid, g->fluid.tiles);
            }
        },
        fluid.pair_data);
    then_restore(f, [&] { load_fluid(fluid, Fields<Pressure>{}); });
}

/// For the walls that fluid or a body may be near and for the bodies: `of_store(store)` is called
/// for each store and gives what is called with each row. Walls away from fluid cost nothing.
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
                column[i] = uniform<typename decltype(field)::type>(0);
            };
        });
    });
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

/// The pairs of a list, whose first particles a loop writes.
struct Sweep {
    const PairList& pairs;
    Destination to;
    std::optional<Rows> blocks = {}; // of the list; none: all
};

/// The records that the terms of a pass read, and the bytes of one: the common ones, or wide ones
/// that are filled from those and from columns first.
struct PassRecords {
    const void* first = nullptr;
    std::size_t bytes = 0;
};
enum class Among { fluid, all };
template <class Pass, class Real>
PassRecords records_of(const Fluid& fluid, PairData<Real>& data, Among which,
                       const FluidTerms& terms)
{
    PassRecords found;
    Pass::call(terms, [&]<class... Terms>(const Terms&...) {
        using List = RecordList<Stored, Terms...>;
        Records<List, Real> records = data.template records<List>();
        if constexpr (!std::is_same_v<List, Stored>) {
            const FluidNeighbours& n = fluid.neighbours;
            const Records<Stored, Real> common = data.records();
            records.complete(common, fluid.particles.fluid, n.fluid);
            if (which == Among::all) {
                records.complete(common, fluid.particles.wall, n.wall, n.wet_walls);
                records.complete(common, fluid.particles.body, n.body);
            }
            if (const Ghosts* const g = fluid.ghosts.get()) {
                records.complete(common, g->particles.fluid, g->fluid.tiles);
                if (which == Among::all) {
                    records.complete(common, g->particles.wall, g->wall.tiles);
                    records.complete(common, g->particles.body, g->body.tiles);
                }
            }
        }
        found = {records.data(), sizeof(RecordRow<List, Real>)};
    });
    return found;
}

/// Runs the loop of a pass over all blocks of some lists: with the kernel of the formulation if
/// they are of fluid alone, else with that of SPH. In MPS solids act on the fluid by the smooth
/// kernel, too: with the weight of MPS the rows of solid particles act as bumps over which fluid
/// does not slide. The pass must be part of this build: passes of effects that are left out have no
/// loop, and nothing that holds such an effect can be made.
template <class Pass>
void run(Fluid& fluid, std::initializer_list<Sweep> sweeps, const FluidTerms& terms)
{
    const bool alone = std::ranges::all_of(
        sweeps, [&](const Sweep& sweep) { return &sweep.pairs == &fluid.neighbours.fluid_fluid; });
    const auto run_all = [&]<class Real, class PairKernel>(PairData<Real>& data,
                                                           const PairKernel& kernel) {
        using Loops = PairLoops<Real, PairKernel>;
        constexpr auto pass = static_cast<std::size_t>(pass_index<Pass, AllPasses>);
        const auto loop = std::get<Loops>(fluid_loops(fluid.instruction_set)).loop[pass];
        const PassRecords records =
            records_of<Pass>(fluid, data, alone ? Among::fluid : Among::all, terms);
        data.local.resize(std::max(data.local.size(), at(thread_count())));
        for (const auto& [pairs, to, some] : sweeps) {
            const Rows blocks = some.value_or(Rows{0, std::ssize(pairs.blocks())});
            for (RecordMemory& local : data.local) {
                local.at_least(at(chunk_slots * pairs.most_chunks()) * records.bytes);
            }
            const typename Loops::View view{pairs.blocks().data(),
                                            records.first,
                                            to.store.pointers(),
                                            to.tiles.row.data(),
                                            to.tiles.first_slot,
                                            to.tiles.lattice.edge,
                                            kernel};
            parallel_blocks(blocks.begin, blocks.end, [&](Index block) {
                loop(view, block, data.local[at(worker())].data(), terms);
            });
        }
    };
    std::visit(
        [&](auto& data) {
            if (alone && fluid.parameters.formulation == FormulationKind::mps) {
                run_all(data, fluid.mps_kernel);
            } else {
                run_all(data, fluid.kernel);
            }
        },
        fluid.pair_data);
}

/// The same over one list.
template <class Pass>
void run(Fluid& fluid, const PairList& pairs, const Destination& to, const FluidTerms& terms)
{
    run<Pass>(fluid, {{pairs, to}}, terms);
}

} // namespace hyoryu
