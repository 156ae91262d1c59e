// SPDX-License-Identifier: MIT
// Input of a plan that is computed from the particles of a filling: counts, extremes, and maps of
// vertical columns, which are small compared with the particles. Several processes reduce their
// results to common ones.
#pragma once

#include "plan_columns.hpp"

#include "hyoryu/ranks/comm.hpp"
#include "hyoryu/scene/fill.hpp"

#include <limits>

namespace hyoryu {

struct PlanFacts {
    Bounds domain;
    std::vector<Diagnostic> warnings;  // of the filling
    std::vector<Diagnostic> faults;    // of the filling
    std::vector<Index> body_points;    // particles of each body
    std::vector<Index> surface_points; // of each body, in its outermost layer

    Index fluid = 0, wall = 0;  // particles
    double particle_volume = 0; // of the fluid [m3], [m2] in two dimensions

    Span height;                           // of the fluid, against gravity, which is not zero [m]
    Span z;                                // of the fluid [m]
    double fastest = 0;                    // speed of the fluid at the start [m/s]
    double deepest = -infinity;            // below the free surface [m]
    std::vector<double> level_before;      // highest fluid before each open side [m]
    std::vector<Span> before_paddle;       // z of the fluid before the face of each wall [m]
    std::vector<double> sponge_is_wet;     // of each sponge: 1 if fluid is in it
    std::vector<std::vector<Vec3>> moving; // particles of each obstacle that moves [m]

    // Only for scenes with bodies, or with gravity along z.
    Columns water;
    std::vector<WallStack> walls; // ascending
    Index unsupported = 0;        // fluid particles without a wall below them
};

/// Whether gravity points along -z, but for a few degrees.
bool falls_along_z(const Scene& scene);

/// `filling`: the part of this process. `comm`: null for one process. Called by all processes.
PlanFacts facts_of(const Scene& scene, const Filling& filling, Comm* comm);

} // namespace hyoryu
