// SPDX-License-Identifier: MIT
// Outlines seen from above, and the prisms that stand on them: buildings from footprints.
#pragma once

#include "hyoryu/geometry/mesh.hpp"

#include <string>
#include <vector>

namespace hyoryu {

/// A corner of a footprint, or a place, seen from above [m].
using Plan2 = std::array<double, 2>;

/// A closed line seen from above, without its first corner at the end again.
using Ring = std::vector<Plan2>;

/// Twice the signed area of the triangle o, a, b: positive if it runs counter-clockwise [m2].
double cross(const Plan2& o, const Plan2& a, const Plan2& b);

/// The area within a ring; negative if it runs clockwise [m2].
double signed_area(const Ring& ring);

/// Whether a point lies within a ring, whichever way it runs.
bool holds(const Ring& ring, const Plan2& point);

/// Most corners of a ring: the search for edges that meet looks at all pairs.
inline constexpr std::size_t most_corners = 2000;

/// The fault of an outer ring and its inner ones as the outline of a solid: too few or too many
/// corners, no area, edges that cross or touch, an inner ring outside of the outer one. Corners are
/// numbered from 1. Empty if there is none.
std::string outline_fault(const std::vector<Ring>& rings);

/// One ring about an area with holes, counter-clockwise: each inner ring is joined to the others by
/// a bridge, an edge that is passed in both directions (Held 2001). Empty if no bridge exists,
/// which cannot happen for an outline without fault.
Ring cut_open(const std::vector<Ring>& rings);

/// The triangles of the area within a ring, counter-clockwise, by ear clipping (Meisters 1975);
/// bridges are allowed. Empty if the ring crosses itself.
std::vector<std::array<int, 3>> ear_triangles(const Ring& ring);

/// The area that two rings share [m2].
double shared_area(const Ring& a, const Ring& b);

/// A solid between two heights on the area within a ring.
struct PrismOutline {
    Ring corners;               // an edge that is passed in both directions has no side
    double bottom = 0, top = 0; // z [m]
};

/// The closed surface of a prism, whichever way its ring runs; empty if the ring crosses itself.
Mesh prism_mesh(const PrismOutline& outline);

} // namespace hyoryu
