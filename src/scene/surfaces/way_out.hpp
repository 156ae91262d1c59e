// SPDX-License-Identifier: MIT
// Where a line along an axis leaves a closed triangle surface.
#pragma once

#include "hyoryu/scene/triangle_tree.hpp"

namespace hyoryu {

/// A direction along an axis: 0, 1 or 2 for x, y or z, and 1 or -1.
struct AxisWay {
    int axis = 0;
    int sense = 1;
};

/// A place where a line leaves a surface.
struct WayOut {
    double distance = infinity; // from the start of the line [m]
    Vec3 normal{0, 0, 1};       // of the triangle there, outwards, unit
};

/// The first place where the line from a point inside a surface leaves it; distance infinity if it
/// is farther away than `farthest` [m]. Where parts overlap, places inside another part are passed
/// over. O(log n) for n triangles of which a line meets few.
WayOut way_out(const TriangleTree& tree, const Vec3& from, const AxisWay& way, double farthest);

} // namespace hyoryu
