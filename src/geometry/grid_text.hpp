// SPDX-License-Identifier: MIT
// Declarations that the readers of height grids share.
#pragma once

#include "hyoryu/core/error.hpp"
#include "hyoryu/geometry/height_grid.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

namespace hyoryu {

inline constexpr double most_grid_cells = 2e8;
/// The mark of a missing height if the file declares none: the default of ESRI's grids.
inline constexpr double none_given = -9999;
inline constexpr const char* grid_in_degrees =
    "the grid seems to be in degrees; reproject it to metres, for instance by `gdalwarp -t_srs "
    "EPSG:32654`";

/// Whether a grid has cells and places that only angles have.
inline bool may_be_degrees(const HeightGrid& grid)
{
    constexpr double degrees = 0.01; // a cell of one centimetre, or of a kilometre
    const auto is_angle = [](double x) { return std::abs(x) <= 360; };
    return std::max(grid.cell[0], grid.cell[1]) < degrees && is_angle(grid.first[0]) &&
           is_angle(grid.first[1]);
}

/// The number that a word is as a whole; none if it is not one.
inline std::optional<double> number_of(std::string_view word)
{
    double value = 0;
    word.remove_prefix(word.starts_with('+') ? 1 : 0);
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool whole = fault == std::errc() && end == word.data() + word.size();
    return whole ? std::optional(value) : std::nullopt;
}

/// Whether a text is a table of places and heights: its first line of content is three numbers, or
/// the names x, y, z.
bool is_point_text(std::string_view text);

/// The grid of a table of places and heights, in any order; commas and semicolons are blanks, `#`
/// begins a comment. -9999 and nan are missing, as are places that no line gives. Throws IoError
/// "FILE:LINE: fault".
HeightGrid grid_of_points(const std::filesystem::path& file, const std::string& text,
                          double substitute);

/// Whether a file is to be read by GDAL: its first bytes are those of a picture, not of a text.
bool is_raster(std::string_view bytes);

/// Reads a file by GDAL. Throws IoError if it cannot, or if this program has no GDAL.
HeightGrid read_raster(const std::filesystem::path& file, double substitute);

} // namespace hyoryu
