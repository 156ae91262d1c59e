// SPDX-License-Identifier: MIT
// Gauges: what an instrument at a place, or on a structure, would read.
#pragma once

#include "hyoryu/core/snapshot.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <vector>

namespace hyoryu {

/// Columns of `gauges.csv` behind the time: one a gauge, three where it reads a vector.
std::vector<Table::Head> gauge_heads(const Scene& scene);

/// Readings in the order of the heads. elevation: height at which the kernel sum of the fluid
/// reaches one half, NaN where there is none; pressure, velocity: kernel average of the fluid, NaN
/// if dry; force: of the fluid on a wall or body, in the last step; front: farthest place of the
/// fluid along the axis.
std::vector<double> read_gauges(const Simulation& sim);

} // namespace hyoryu
