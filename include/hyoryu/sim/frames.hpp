// SPDX-License-Identifier: MIT
// The state as clouds and surfaces, ready to be written as frames. Of several processes each has
// the fluid of its own tiles, which in the order of the ranks is that of one process.
#pragma once

#include "hyoryu/core/snapshot.hpp"
#include "hyoryu/sim/simulation.hpp"

namespace hyoryu {

/// Fluid particles with Id, Velocity, Pressure, Density, Kind, Body and the fields of
/// `output.fields`.
Cloud fluid_cloud(const Simulation& sim);
/// Body particles: those of the fluid coupling, which are the aggregate itself without a fluid.
Cloud body_cloud(const Simulation& sim);
/// The same with the particles of all processes; null without fluid.
Cloud body_cloud(const Simulation& sim, const Store* particles);
/// Wall particles at their present place, in the order of their numbers.
Cloud wall_cloud(const Simulation& sim);

/// Numbers of particles [begin, end).
struct NumberRange {
    std::int64_t begin = 0, end = 0;
};
NumberRange all_walls(const Simulation& sim);
/// The wall particles for which this process has values; others are dry.
Cloud wall_rows_cloud(const Simulation& sim);
/// All wall particles of a range; `rows`: those of them for which any process has values.
Cloud wall_cloud(const Simulation& sim, Cloud rows, const NumberRange& range);

/// The numbers of the particles of a cloud.
std::vector<std::int64_t> numbers_in(const Cloud& cloud);
/// The points of these indices.
Cloud some_points(const Cloud& cloud, std::span<const std::int32_t> rows);

/// Surfaces of all bodies at their present pose, with Body and Velocity at the corners.
Surface body_surface(const Simulation& sim);
/// Surfaces of all walls where they are at the time of the clock, with Wall (index) at the corners.
Surface wall_surface(const Scene& scene, const Bounds& domain, const Clock& clock);

} // namespace hyoryu
