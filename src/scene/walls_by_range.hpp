// SPDX-License-Identifier: MIT
// Walls of a case that several processes fill.
#pragma once

#include "fill_region.hpp"

namespace hyoryu {

/// Appends the wall particles in the region of this process, with those at windows carried out, and
/// the runs of all; returns the regions, into which the fluid of `filling` and the walls are cut.
/// Called by all processes.
///
/// Which places of the layers get a particle depends on those before them, as `fill_walls` takes
/// them. Each process goes through the places in its region and believes what the others say of
/// theirs that are near; all go on until nobody says anything new. Each time one more of the
/// decisions that follow from each other is right, so that the end is what one process finds.
FillRegion fill_walls_by_range(const Scene& scene, Comm& comm, Filling& filling);

} // namespace hyoryu
