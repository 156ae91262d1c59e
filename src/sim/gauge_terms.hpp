// SPDX-License-Identifier: MIT
// Contributions of the particles of a process to the readings of the gauges, in the order of their
// slots. The contributions of all processes, concatenated, equal those of a single process.
#pragma once

#include "gauge_search.hpp"
#include "hyoryu/core/fixed_sum.hpp"
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

/// A fluid particle that may be near a gauge.
struct FluidNear {
    Vec3 place{0, 0, 0};    // [m]
    Vec3 velocity{0, 0, 0}; // [m/s]
    double volume = 0;      // [m3], [m2] in two dimensions
    double pressure = 0;    // [Pa]
    double density = 0;     // [kg/m3]
};

/// A wall or body particle that may be near a gauge.
struct SolidNear {
    Vec3 place{0, 0, 0}; // [m]
    double volume = 0;   // [m3], [m2] in two dimensions
};

struct GaugeTerms {
    std::vector<FluidNear> fluid;
    std::vector<SolidNear> wall, body; // for elevations alone
    double farthest = -infinity;       // place of the fluid along the axis of a front [m]
    FixedSum flux;                     // in the unit of fluxes
};
GaugeTerms terms_of(const Fluid& fluid, const GaugeSearch& search, const Gauge& gauge);

/// Gathers the terms of all ranks on rank 0, gauge by gauge; the other ranks keep none. Called by
/// all ranks.
void gather_terms(Comm& comm, std::vector<GaugeTerms>& terms);

/// Points that stand for the face of a sensor: the middles of equal parts of a length, or a spiral
/// of equal areas over a disc; not closer than half a spacing, which the kernel would not tell
/// apart.
std::vector<Vec3> face_points(const Gauge& gauge, const Fluid& fluid);

/// From a particle, or its nearest image, to a place [m].
Vec3 shortest_way(const Fluid& fluid, const Vec3& from, const Vec3& to);

} // namespace hyoryu
