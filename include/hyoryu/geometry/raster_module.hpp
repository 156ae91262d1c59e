// SPDX-License-Identifier: MIT
// Interface of the module that reads rasters by GDAL, which the program loads when one is read:
// GDAL and its 100 shared libraries would slow every start of the program.
#pragma once

#include "hyoryu/geometry/height_grid.hpp"

namespace hyoryu::raster_module {

/// Exceptions pass through: program and module are of one build.
using ReadRaster = void (*)(const std::filesystem::path& file, double substitute, HeightGrid& grid);
inline constexpr const char* read_raster_name = "hyoryu_module_read_raster";
inline constexpr const char* file_name = "libhyoryu_gis.so";

} // namespace hyoryu::raster_module
