// SPDX-License-Identifier: MIT
// Surfaces of shapes and walls as triangles, for pictures.
#pragma once

#include "hyoryu/scene/shapes.hpp"

#include <array>

namespace hyoryu {

/// Triangles that wind outwards; in two dimensions the section itself, at y = 0.
struct TriangleSurface {
    std::vector<Vec3> corners; // [m]
    std::vector<std::array<int, 3>> triangles;
};

/// The surface of a shape in its own axes.
TriangleSurface triangles_of(const Shape& shape, int dimensions);

/// The surface of a wall in space: planes are clipped to the domain, basins show their inside
/// faces.
TriangleSurface triangles_of(const Wall& wall, const Bounds& domain, int dimensions);

} // namespace hyoryu
