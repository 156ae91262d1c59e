// SPDX-License-Identifier: MIT
// How well the surface of a terrain follows its grid.
#pragma once

#include "hyoryu/geometry/height_grid.hpp"

namespace hyoryu {

/// Differences of surface and grid in the window of a patch, without those due to level areas.
struct SurfaceCheck {
    std::array<Index, 2> cells{0, 0};    // of the surface along x and y
    double lowest = 0, highest = 0;      // of the surface [m]
    Index compared = 0;                  // heights of the grid within the window
    double rms = 0;                      // of grid less surface [m]
    double largest = 0;                  // of its magnitude [m]
    std::array<double, 2> at{0, 0};      // where: x, y [m]
    Index steep = 0;                     // cells steeper than 45 degrees
    double step = 0;                     // greatest difference of height within a steep cell [m]
    std::array<double, 2> step_at{0, 0}; // middle of that cell: x, y [m]
};

/// `heights` on the lattice of the patch, as `sample_heights` gives them.
SurfaceCheck check_surface(const HeightGrid& grid, const TerrainPatch& patch,
                           const std::vector<double>& heights);

} // namespace hyoryu
