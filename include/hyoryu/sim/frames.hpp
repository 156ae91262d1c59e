// SPDX-License-Identifier: MIT
// The state as clouds and surfaces, ready to be written as frames.
#pragma once

#include "hyoryu/core/snapshot.hpp"
#include "hyoryu/sim/simulation.hpp"

namespace hyoryu {

/// Fluid particles with Id, Velocity, Pressure, Density, Kind, Body and the fields of
/// `output.fields`.
Cloud fluid_cloud(const Simulation& sim);
/// Body particles: those of the fluid coupling, which are the aggregate itself without a fluid.
Cloud body_cloud(const Simulation& sim);
/// Wall particles at their present place.
Cloud wall_cloud(const Simulation& sim);
/// Surfaces of all bodies at their present pose, with Body and Velocity at the corners.
Surface body_surface(const Simulation& sim);
/// Surfaces of all walls where they are at the time of the clock, with Wall (index) at the corners.
Surface wall_surface(const Scene& scene, const Bounds& domain, const Clock& clock);

} // namespace hyoryu
