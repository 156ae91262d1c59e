// SPDX-License-Identifier: MIT
// The particles that fill a simple shape, by their number: each can be made without the others.
#pragma once

#include "hyoryu/scene/scene.hpp"

#include <array>
#include <variant>
#include <vector>

namespace hyoryu {

/// A particle in the axes of its shape.
struct ShapePoint {
    Vec3 place{0, 0, 0};     // [m]
    bool on_surface = false; // in the outermost layer
};

/// A lattice in a box, x fastest.
struct BoxPoints {
    Vec3 size{0, 0, 0}; // [m]
    std::array<Index, 3> count{};
    int dimensions = 3;

    Index number() const { return count[0] * count[1] * count[2]; }
    ShapePoint point(Index k) const;
};

/// Rings of a disc, layer by layer from outside, in planes along the x axis; in two dimensions one
/// plane. Alternate rings are turned by half a particle so that rows do not line up radially.
struct RingPoints {
    double length = 0; // along x [m]
    Index planes = 1;
    double radius = 0;        // [m]
    std::vector<Index> start; // first point of each ring, and their number at the end
    int dimensions = 3;

    Index number() const { return planes * start.back(); }
    ShapePoint point(Index k) const;
};

/// Shells of a ball, layer by layer from outside, each a spiral of equal areas.
struct ShellPoints {
    double radius = 0;        // [m]
    std::vector<Index> start; // first point of each shell, and their number at the end

    Index number() const { return start.back(); }
    ShapePoint point(Index k) const;
};

/// Points of a list, which must stay where it is while they are used.
struct GivenPoints {
    const std::vector<Vec3>* points = nullptr;

    Index number() const { return static_cast<Index>(points->size()); }
    ShapePoint point(Index k) const { return {(*points)[at(k)]}; }
};

using ShapePoints = std::variant<BoxPoints, RingPoints, ShellPoints, GivenPoints>;

ShapePoints shape_points(const BoxShape& box, double spacing, int dimensions);
ShapePoints shape_points(const SphereShape& sphere, double spacing, int dimensions);
ShapePoints shape_points(const CylinderShape& cylinder, double spacing, int dimensions);

/// The number of points, and the point with number k below that.
Index number_of(const ShapePoints& points);
ShapePoint point_of(const ShapePoints& points, Index k);

} // namespace hyoryu
