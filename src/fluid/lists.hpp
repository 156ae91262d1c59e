// SPDX-License-Identifier: MIT
// The steps of rebuilding neighbour lists, see fluid.hpp.
#pragma once

#include "hyoryu/fluid/fluid.hpp"

namespace hyoryu {

/// The tiles of walls against which relative motion is measured. They include fixed walls that do
/// not exist yet, as these are made when fluid approaches.
const Tiles& measured_walls(const Fluid& fluid);
/// Bounds of how far particles of walls have moved.
void measure_walls(Fluid& fluid);
/// Bounds of how far fluid and body particles of this rank have moved; the largest length.
real measure_own(Fluid& fluid);
/// The largest motions since the lists were made, of all ranks.
Displacement measure(Fluid& fluid);

/// Makes the fixed-wall particles that lists may contain, and drops the others.
void update_fixed_walls(Fluid& fluid);
/// Puts all particles into the order of tiles, and makes the ghosts anew.
void sort_particles(Fluid& fluid);

/// Makes all lists.
void build_lists(Fluid& fluid);

} // namespace hyoryu
