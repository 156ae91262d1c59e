// SPDX-License-Identifier: MIT
// Fluid in the packing that still water keeps.
#pragma once

#include "fill_region.hpp"

namespace hyoryu {

/// Moves the particles marked in `fluid_cut` to where the pressure of their depth carries them, as
/// the symmetric pressure force of SPH has it,
///
///     g - |g| sum V (d_i + d_j) F r = 0,   d the depth, of solids the one that i sees there,
///
/// so that a start at hydrostatic pressure is one at rest; pairs nearer than
/// `PackingPressure::apart` repel each other by more. Cells that a surface cuts leave the water
/// beside it up to a quarter thinner or denser than the lattice, which the first second of a run
/// would even out with pressures wrong by as much. Descent with momentum (Polyak 1964) in fixed
/// rounds; masses stay, depths follow the places, and no particle comes nearer to a surface than it
/// may be filled. Particles beside an open side of the water, or without support below, are not
/// moved, since they are not at rest. Without gravity or marks nothing is done, nor where a block
/// is in layers, which follow the surfaces themselves. Several processes each move what is in their
/// region, and get the places of what they see of others after each round. `region`: null for one
/// process.
void relax_packing(const Scene& scene, const FillRegion* region, Filling& filling);

} // namespace hyoryu
