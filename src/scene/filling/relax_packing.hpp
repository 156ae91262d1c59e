// SPDX-License-Identifier: MIT
// Relaxation of the initial fluid to a packing that is in equilibrium in still water.
#pragma once

#include "fill_region.hpp"

namespace hyoryu {

/// Moves the particles marked in `fluid_cut` to where the pressure of their depth carries them, as
/// the symmetric pressure force of SPH has it,
///
///     g - |g| sum V (d_i + d_j) F r = 0,   d the depth, of solids the one that i sees there,
///
/// so that a start at hydrostatic pressure is at rest; pairs nearer than `PackingPressure::apart`
/// repel each other by more. Cells that a surface cuts leave the water beside it up to a quarter
/// thinner or denser than the lattice, which the first second of a run would even out with
/// pressures wrong by as much. Descent with momentum (Polyak 1964) in fixed rounds; masses stay,
/// depths follow the places, and no particle comes nearer to a surface than the filling allows.
/// Particles beside an open side of the water, or without support below, are not moved, since they
/// are not at rest. Without gravity or marks nothing is done, nor where a block is in layers, which
/// follow the surfaces themselves. Each of several processes moves the particles of its region and
/// receives the places of neighbouring particles of other processes after each round. `region`:
/// null for one process.
void relax_packing(const Scene& scene, const FillRegion* region, Filling& filling);

} // namespace hyoryu
