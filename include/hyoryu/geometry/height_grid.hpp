// SPDX-License-Identifier: MIT
// Terrain from height grids: a grid is read from its file, sampled on a lattice in the axes of a
// case and closed below, so that filling, contact and pictures treat it as any closed mesh.
#pragma once

#include "hyoryu/geometry/outline.hpp"

#include <optional>

namespace hyoryu {

/// Heights of the ground at the centres of the cells of a regular grid.
struct HeightGrid {
    Index columns = 0, rows = 0;
    std::array<double, 2> first{}; // easting and northing of the south-western centre [m]
    std::array<double, 2> cell{};  // distance of the centres to the east and to the north [m]
    std::vector<double> height;    // [m], from the south-western centre, eastward; NaN: missing
};

/// Reads a grid by what the file holds. An ESRI ASCII grid: keys in any case and before or after
/// their number (as GeoClaw writes them), `xllcorner` or `xllcenter`, `cellsize` or `dx` and `dy`;
/// rows from north to south. Lines of x, y, z on a regular grid, in any order. GeoTIFF and other
/// files that are not text: by GDAL, from a module that is loaded then. Missing heights become
/// `substitute`, or NaN. Throws IoError "FILE:LINE: fault", also for a grid in degrees.
HeightGrid read_height_grid(const std::filesystem::path& file,
                            std::optional<double> substitute = {});

/// The height at a place, bilinear between the four centres about it; constant in the outer half
/// of the outermost cells; NaN outside the grid or beside a missing height [m].
double height_at(const HeightGrid& grid, double easting, double northing);

/// A quay or a yard that a grid smears: the ground within the ring has this height.
struct LevelArea {
    Ring corners; // in the axes of the case [m]
    double z = 0; // [m]
};

/// The part of a grid that a case takes, and how the axes of the case lie in it.
struct TerrainPatch {
    std::array<double, 2> origin{}; // easting and northing of x = y = 0 [m]
    double azimuth_deg = 90;        // of the x axis, clockwise from north
    double datum = 0;               // z of the height 0 [m]
    std::array<double, 4> extent{}; // x_min, y_min, x_max, y_max [m]
    double resolution = 0;          // longest edge of the lattice of the surface [m]
    double bottom = 0;              // z of the lower side of the solid [m], below all heights
    std::optional<double> nodata;   // the height where the grid has none [m]; none: an error
    std::vector<LevelArea> levels;  // a later one covers those before it
};

/// The rectangle in x and y that the centres of the grid cover: x_min, y_min, x_max, y_max [m].
/// None if the axes of the patch are not parallel to those of the grid.
std::optional<std::array<double, 4>> covered_extent(const HeightGrid& grid,
                                                    const TerrainPatch& patch);

/// Heights on the lattice of a patch, x fastest: means over the cells of a lattice that is coarser
/// than the grid, else bilinear; within a level area its z. NaN where the grid has none [m].
std::vector<double> sample_heights(const HeightGrid& grid, const TerrainPatch& patch);

/// Points of the lattice of a patch within a ring.
Index points_within(const TerrainPatch& patch, const Ring& ring);

/// Cells of the lattice along x and y.
std::array<Index, 2> lattice_cells(const TerrainPatch& patch);

/// The closed solid between heights on the lattice of a patch and its bottom. Each cell is two
/// triangles, divided along the diagonal with the smaller difference in height.
Mesh terrain_mesh(const TerrainPatch& patch, const std::vector<double>& heights);

} // namespace hyoryu
