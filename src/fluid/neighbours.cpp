// SPDX-License-Identifier: MIT
// Decides when the neighbour lists of the fluid are rebuilt, and prepares their input.
#include "hyoryu/fluid/whole.hpp"

#include "lists.hpp"
#include "sharing.hpp"
#include "sweeps.hpp"

namespace hyoryu {

namespace {

// Edge of a tile relative to the support: about a hundred particles per tile in two and in three
// dimensions. A skin is at most the difference between edge and support.
real tile_ratio(int dimensions)
{
    return dimensions == 2 ? 2.5 : 2.0;
}

// Whether an unlisted pair may have come within the support. Pairs of touching tiles are checked by
// their relative displacement, all others by the distance between tiles that do not touch.
bool stale(const Fluid& fluid, const Displacement& motion)
{
    const FluidNeighbours& n = fluid.neighbours;
    const real between = n.fluid.lattice.edge.minCoeff() - fluid.kernel.support;
    return motion.fluid > n.skins.fluid || motion.solid > n.skins.solid ||
           2 * motion.absolute > between;
}

// Resets all solid particles to the state far from fluid: no pressure, no force. The stages of a
// step update those near fluid.
void dry(Fluid& fluid)
{
    if (!has_solids(fluid)) {
        return;
    }
    for_solids(fluid.particles, [&](Store& store) {
        clear(store, Fields<Pressure, Force, ShepardSum>{});
        const auto rho = store[field::density];
        const auto V = store[field::volume];
        const auto mass = store[field::displaced_mass];
        parallel_for(0, store.size(), [&](Index i) {
            rho[i] = fluid.parameters.eos.rho0;
            V[i] = mass[i] / rho[i];
        });
    });
}

} // namespace

TileLattice lattice_of(const Fluid& fluid)
{
    const Vec3 origin = fluid.domain_min.allFinite() ? fluid.domain_min : Vec3(Vec3::Zero());
    return make_lattice(origin, tile_ratio(fluid.parameters.dimensions) * fluid.kernel.support,
                        fluid.period);
}

void place_fixed_walls(Fluid& fluid)
{
    for (Tiles* tiles : {&fluid.neighbours.fluid, &fluid.neighbours.body}) {
        tiles->lattice = lattice_of(fluid);
        bound_chunks(*tiles);
    }
    if (fluid.ghosts) {
        keep_tiles(fluid.neighbours.body, own_tiles(fluid));
        make_ghosts_of_fluid(fluid);
        make_ghosts_of_bodies(fluid);
    }
    update_fixed_walls(fluid);
}

void update_neighbours(Fluid& fluid)
{
    if (lists_are_due(fluid, false)) {
        make_lists(fluid);
    }
}

bool lists_are_due(Fluid& fluid, bool asked)
{
    FluidNeighbours& n = fluid.neighbours;
    n.steps += 1;
    if (n.builds == 0) {
        n.skins = n.skins.fluid > 0 ? n.skins : first_skins(fluid.parameters.spacing);
        return true;
    }
    const Displacement motion = measure(fluid);
    if (!asked && !stale(fluid, motion)) {
        return false;
    }
    n.skins = best_skins(motion, n.steps, n.entries, n.skins, fluid.kernel.support,
                         fluid.parameters.spacing);
    return true;
}

void make_lists(Fluid& fluid)
{
    FluidNeighbours& n = fluid.neighbours;
    sort_particles(fluid);
    build_lists(fluid);
    dry(fluid);
    n.builds += 1;
    n.steps = 0;
}

void rebuild_neighbours(Fluid& fluid)
{
    for (Tiles* tiles : {&fluid.neighbours.fluid, &fluid.neighbours.wall, &fluid.neighbours.body}) {
        tiles->lattice = lattice_of(fluid);
        bound_chunks(*tiles);
    }
    make_ghosts_of_walls(fluid);
    build_lists(fluid);
    dry(fluid); // a new store holds the pressures of time 0
    if (!fluid.moving_walls) {
        measure_walls(fluid);
    }
}

} // namespace hyoryu
