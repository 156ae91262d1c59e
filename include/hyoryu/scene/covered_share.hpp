// SPDX-License-Identifier: MIT
// Moving walls within fixed ones.
//
// A part of a moving wall may lie within a fixed wall: the foot of a paddle in the floor, or a
// piston that starts in line with the side of a basin. What two walls share must act on the water
// once. Fixed walls keep their volume; a particle of a moving wall has that of the part of its cell
// outside of all fixed walls, which changes as the wall moves.
#pragma once

#include "hyoryu/scene/scene.hpp"
#include "hyoryu/scene/solid_surface.hpp"

#include <span>
#include <vector>

namespace hyoryu {

/// The periodic directions of a scene; length 0 along the others [m].
struct Periods {
    Vec3 first{0, 0, 0}, length{0, 0, 0};
};

Periods periods_of(const Scene& scene);

/// The numbers of the walls that do not move.
std::vector<int> fixed_walls_of(const Scene& scene);

/// The share of a cell about a place, or about its image in the domain, that lies outside of the
/// walls `fixed`, by 27 parts of it, of which each wall cuts one by a plane. `edge`: of the cell
/// [m]. `surfaces`: of all walls.
double uncovered_share(std::span<const SolidSurface> surfaces, std::span<const int> fixed,
                       const Vec3& place, double edge, const Periods& periods);

} // namespace hyoryu
