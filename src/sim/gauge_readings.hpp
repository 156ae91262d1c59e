// SPDX-License-Identifier: MIT
// Readings of the fluid gauges at one time. Each evaluates only the particles around it, in the
// order of their rows, so that the sums have the bits of sums over all particles.
#pragma once

#include "gauge_search.hpp"
#include "hyoryu/fluid/fluid.hpp"
#include "hyoryu/scene/scene.hpp"

#include <vector>

namespace hyoryu {

/// Where particles are when a row of gauges is read.
struct GaugeSearch {
    TileBounds fluid;
    TileBounds wall, body; // for elevations alone
};

/// Computes the search structure that the fluid gauges need.
GaugeSearch make_gauge_search(const Fluid& fluid, const std::vector<Gauge>& gauges);

/// The raw columns of a gauge; none of a force gauge. See `read_gauges`.
std::vector<double> read_fluid(const Fluid& fluid, const GaugeSearch& search, const Gauge& gauge);

} // namespace hyoryu
