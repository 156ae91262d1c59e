// SPDX-License-Identifier: MIT
// The pressure in the joints of one body, from that of the fluid at their rims.
#pragma once

#include "joint_gaps.hpp"

namespace hyoryu {

/// The particle state that the joints read.
struct ParticlePressure {
    std::span<const Vec3> x;       // of all rows [m]
    std::span<const real> p;       // [Pa]; of solids extrapolated from the fluid
    std::span<const real> shepard; // of solids: sum W over the fluid [1/m^d]
    std::size_t first = 0;         // row of the first particle of the body
    double spacing = 0;            // of the fluid [m]
    double support = 0;            // radius of its kernel [m]
    Vec3 weight{0, 0, 0};          // rho0 g [N/m3]
    double density = 0;            // rho0 [kg/m3]
    double sound = 0;              // its speed at rest [m/s]
    double dt = 0;                 // of the step [s]
    double dt_before = 0;          // of the step before; 0 at the first [s]
};

/// Pressures of all nodes of body b whose gaps are known.
void solve_pressure(JointTables& tables, const Rigid& rigid, const std::vector<Pose>& poses, int b,
                    const ParticlePressure& fluid);

} // namespace hyoryu
