// SPDX-License-Identifier: MIT
// Polygons seen from above, from GeoJSON files or from the case.
#pragma once

#include "ground.hpp"

#include <filesystem>

namespace hyoryu {

/// The outer ring of the only polygon of a GeoJSON file (RFC 7946): a Polygon, a MultiPolygon of
/// one, or a Feature or FeatureCollection of one; other geometries are not looked at. Throws
/// IoError "FILE: fault".
std::vector<Plan2> read_polygon(const std::filesystem::path& file);

/// The reason why a polygon cannot serve as a yard: too few or too many corners, or edges that
/// cross; empty if it can.
std::string fault_of_yard(const std::vector<Plan2>& polygon);

/// Whether all coordinates are within the range of longitudes and latitudes.
bool may_be_degrees(const std::vector<Plan2>& polygon);

/// The convex hull of some points, counter-clockwise.
std::vector<Plan2> hull_of(std::vector<Plan2> points);

/// Eastings and northings to the axes of a terrain.
void into_axes_of(const TerrainPatch& patch, std::vector<Plan2>& polygon);

/// Whether a point lies within a polygon, whichever way it runs.
bool holds(const std::vector<Plan2>& polygon, const Plan2& point);

/// Whether a convex polygon lies within another polygon: its corners do, and no edges cross.
bool holds_all(const std::vector<Plan2>& polygon, const std::vector<Plan2>& inner);

/// Distance of two convex polygons that run counter-clockwise, by their edges; negative if they
/// overlap [m]. Up to the corner distance it is that along the best normal of an edge.
double apart(const std::vector<Plan2>& a, const std::vector<Plan2>& b);

} // namespace hyoryu
