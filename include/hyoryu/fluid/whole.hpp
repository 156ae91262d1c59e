// SPDX-License-Identifier: MIT
// From a fluid of one process to that of one of several, and back: what is read and written, such
// as a checkpoint, is whole and shows neither that there were ranks nor how many.
#pragma once

#include "hyoryu/fluid/fluid.hpp"

namespace hyoryu {

/// The parts of a fluid in which the store of a rank differs from that of one process.
struct WholeFluid {
    Particles particles;
    Tiles fluid, wall, body;
};

/// Gathers the particles and tiles of all ranks on rank 0, in the order of one process. Called by
/// all ranks; empty on the others.
WholeFluid gather_whole(const Fluid& fluid);

/// Exchanges the parts of a fluid with those of another, and its ghosts.
void swap_parts(Fluid& fluid, WholeFluid& whole, std::unique_ptr<Ghosts>& ghosts);

/// Cuts by which all ranks have about the same number of fluid particles.
Cuts even_cuts(const TileLattice& lattice, std::span<const Vec3> fluid, int ranks);

/// Makes a fluid that one process has restored that of one of several, which keeps its own
/// particles. Called by all ranks, with the same fluid.
void keep_share(Fluid& fluid, Comm& comm);

} // namespace hyoryu
