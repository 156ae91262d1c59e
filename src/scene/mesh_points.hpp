// SPDX-License-Identifier: MIT
// Particles of a mesh on a lattice.
#pragma once

#include "hyoryu/scene/scene.hpp"
#include "hyoryu/scene/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hyoryu {

/// Cells of about the spacing along a length, at least one.
inline Index cells(double length, double spacing)
{
    return std::max<Index>(1, std::llround(length / spacing));
}

/// Middle of cell k of n over [-length/2, length/2].
inline double middle(Index k, Index n, double length)
{
    return ((static_cast<double>(k) + 0.5) / static_cast<double>(n) - 0.5) * length;
}

/// A lattice point inside a mesh.
struct MeshPoint {
    Vec3 place{0, 0, 0}; // [m]
    NearestPlace nearest;
};

struct MeshPoints {
    std::vector<MeshPoint> points;
    Vec3 cell{0, 0, 0}; // edges of the lattice over the box of the mesh [m]
};

/// The lattice points inside a mesh that are at most `depth` below its surface [m], x fastest; the
/// centre of its box if the mesh is thinner than a cell everywhere. O(log n) a point for n
/// triangles.
MeshPoints points_within(const MeshShape& mesh, const TriangleTree& tree, double spacing,
                         double depth);

} // namespace hyoryu
