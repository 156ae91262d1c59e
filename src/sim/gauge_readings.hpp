// SPDX-License-Identifier: MIT
// Readings of the fluid gauges at one time, from the particles around each: their sums have the
// bits of sums over all particles.
#pragma once

#include "gauge_terms.hpp"

namespace hyoryu {

/// The raw columns of a gauge; none of a force gauge. See `read_gauges`. `terms`: of all processes.
std::vector<double> read_fluid(const Fluid& fluid, const GaugeTerms& terms, const Gauge& gauge);

} // namespace hyoryu
