// SPDX-License-Identifier: MIT
// Polygons and footprints from GeoJSON files (RFC 7946), in the coordinates of the file.
#pragma once

#include "hyoryu/geometry/outline.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hyoryu {

/// The outer ring of the only polygon of a file: a Polygon, a MultiPolygon of one, or a Feature or
/// FeatureCollection of one; other geometries are not looked at. Throws IoError "FILE: fault".
Ring read_polygon(const std::filesystem::path& file);

/// A building as a file has it.
struct Footprint {
    std::vector<Ring> rings; // the outer one first, then those of courtyards
    std::string where;       // in the file, as messages name it: "feature 3"
    std::string name;        // of the property; empty without one
    double height = 0;       // [m]
    std::size_t number = 0;  // among the polygons of the file, from 1 on
};

/// Where the heights and names of footprints come from.
struct FootprintKeys {
    std::string height_property;  // its name, or empty:
    std::optional<double> height; // of all [m]
    std::string name_property;    // may be empty
};

struct Footprints {
    std::vector<Footprint> list;
    std::vector<std::string> faults; // "FILE: feature 3: ..."; the list is not complete with some
};

/// All polygons of a file. A MultiPolygon is as many footprints, NAME.1, NAME.2 ... Throws IoError
/// "FILE: fault" if it is not GeoJSON.
Footprints read_footprints(const std::filesystem::path& file, const FootprintKeys& keys);

} // namespace hyoryu
