// SPDX-License-Identifier: MIT
// The parts of making neighbour lists, see fluid.hpp.
#pragma once

#include "hyoryu/fluid/fluid.hpp"

namespace hyoryu {

/// The tiles of walls against which others are measured. Fixed walls that do not exist yet count:
/// the fluid that comes to them is what makes them.
const Tiles& measured_walls(const Fluid& fluid);
/// Bounds of how far particles of walls have moved.
void measure_walls(Fluid& fluid);
/// Bounds of how far fluid and body particles of this rank have moved; the largest length.
real measure_own(Fluid& fluid);
/// The largest motions since the lists were made, of all ranks.
Displacement measure(Fluid& fluid);

/// Makes the fixed walls that lists may know, and drops the others.
void update_fixed_walls(Fluid& fluid);
/// Puts all particles into the order of tiles, and makes the ghosts anew.
void sort_particles(Fluid& fluid);

/// Makes all lists.
void build_lists(Fluid& fluid);

} // namespace hyoryu
