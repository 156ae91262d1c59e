// SPDX-License-Identifier: MIT
// Polygons seen from above.
#pragma once

#include "ground.hpp"

namespace hyoryu {

/// The rectangle about some places, along the axes [m].
struct Frame2 {
    Plan2 low{infinity, infinity};
    Plan2 high{-infinity, -infinity};
};

Frame2 frame_of(const Ring& ring);

/// The reason why a polygon cannot serve as a yard: too few or too many corners, or edges that
/// cross; empty if it can.
std::string fault_of_yard(const std::vector<Plan2>& polygon);

/// Whether all coordinates are within the range of longitudes and latitudes.
bool may_be_degrees(const std::vector<Plan2>& polygon);

/// The convex hull of some points, counter-clockwise.
std::vector<Plan2> hull_of(std::vector<Plan2> points);

/// Eastings and northings to the axes of a terrain.
void into_axes_of(const TerrainPatch& patch, std::vector<Plan2>& polygon);

/// Whether a convex polygon lies within another polygon: its corners do, and no edges cross.
bool holds_all(const std::vector<Plan2>& polygon, const std::vector<Plan2>& inner);

/// Distance of two convex polygons that run counter-clockwise, by their edges; negative if they
/// overlap [m]. Up to the corner distance it is that along the best normal of an edge.
double apart(const std::vector<Plan2>& a, const std::vector<Plan2>& b);

} // namespace hyoryu
