// SPDX-License-Identifier: MIT
// The ground of a terrain wall, from its height grid and the keys of the resolved case.
#pragma once

#include "scene.hpp"

#include <filesystem>

namespace witness {

/// How a resolved case places a grid; the meanings are those of its keys.
struct Placement {
    double east = 0, north = 0;                          // origin [m]
    double azimuth = 90;                                 // [deg]
    double datum = 0, bottom = 0;                        // [m]
    double low_x = 0, low_y = 0, high_x = 0, high_y = 0; // extent [m]
    double resolution = 1;                               // [m]
    double nodata = 0;                                   // the height of missing cells [m]
};

/// A closed solid below the ground, in the axes of the case. Throws std::runtime_error if the grid
/// cannot be read.
Mesh ground_of(const std::filesystem::path& grid, const Placement& placement);

} // namespace witness
