// SPDX-License-Identifier: MIT
// The cells of water that the particles of walls and bodies stand for.
#pragma once

#include "fill_neighbours.hpp"

#include <vector>

namespace hyoryu {

struct SolidCells {
    std::vector<Vec3> points; // [m]
    std::vector<float> cubes; // volumes [cubes of the spacing]
};

/// Those of the walls, then those of the bodies, at time 0. `wall_cubes`: of the walls of this
/// process. `neighbours`: null for one process.
SolidCells solid_cells(const Scene& scene, const Filling& filling, std::vector<float> wall_cubes,
                       const FillNeighbours* neighbours);

} // namespace hyoryu
