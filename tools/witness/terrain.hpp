// SPDX-License-Identifier: MIT
// The ground of a terrain wall, from its height grid and the keys of the resolved case.
#pragma once

#include "scene.hpp"

#include <filesystem>
#include <vector>

namespace witness {

/// A [[wall.level]]: the ground within the polygon, whose corners' z does not count, lies at z.
struct Level {
    std::vector<Vec3> corners; // in the axes of the case [m]
    double z = 0;              // [m]
};

/// How a resolved case places a grid; the meanings are those of its keys.
struct Placement {
    double east = 0, north = 0;                          // origin [m]
    double azimuth = 90;                                 // [deg]
    double datum = 0, bottom = 0;                        // [m]
    double low_x = 0, low_y = 0, high_x = 0, high_y = 0; // extent [m]
    double resolution = 1;                               // [m]
    double nodata = 0;                                   // the height of missing cells [m]
    std::vector<Level> levels;                           // a later one covers those before it
};

/// A closed solid below the ground, in the axes of the case. Throws std::runtime_error if the grid
/// cannot be read.
Mesh ground_of(const std::filesystem::path& grid, const Placement& placement);

} // namespace witness
