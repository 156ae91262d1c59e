// SPDX-License-Identifier: MIT
// Walls of a case that several processes fill.
#pragma once

#include "fill_region.hpp"

namespace hyoryu {

/// Appends the wall particles in the region of this process, with those at windows carried out, and
/// the runs of the wall particles of all processes. Returns the regions, which hold about equal
/// numbers of fluid particles of `filling` and places of walls. Called by all processes.
///
/// A place of the layers that no other wall has a better claim to (`OverlapOwner`) gets a particle
/// unless an earlier place, in the order of `fill_walls`, has one too near to it. The selection is
/// iterated: each process selects among the places in its region, given what the other processes
/// selected near it in the iteration before, until no selection changes. At that fixed point the
/// selection is that of one process, by induction over the order of the places: each depends on
/// earlier ones only.
FillRegion fill_walls_by_range(const Scene& scene, Comm& comm, Filling& filling);

} // namespace hyoryu
