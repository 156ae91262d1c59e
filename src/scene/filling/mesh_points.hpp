// SPDX-License-Identifier: MIT
// Particles of a mesh on a lattice.
#pragma once

#include "scene/surfaces/cells.hpp"

#include "hyoryu/ranks/comm.hpp"
#include "hyoryu/scene/scene.hpp"
#include "hyoryu/scene/triangle_tree.hpp"

#include <algorithm>
#include <array>
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

/// Cells of about the spacing in the box of a mesh. The number behind that of the last one stands
/// for the centre, for a mesh that is thinner than a cell everywhere.
Cells mesh_lattice(const MeshShape& mesh, double spacing);

/// How far points may be from the surface of a mesh [m].
struct DepthRange {
    double below = infinity;
    double above = 0;
};

/// A lattice point inside a mesh or near its surface.
struct MeshPoint {
    Index number = 0;    // of its cell
    Vec3 place{0, 0, 0}; // [m]
    NearestPlace nearest;
};

/// The lattice points below the surface of a mesh, or above it, within that range, by number; the
/// centre if there is none and it is as near. The cost is that of the cells near the surface where
/// the range is finite, O(log n) a cell for n triangles. Of several processes, which call it
/// together, each gets a part.
std::vector<MeshPoint> points_within(const Cells& lattice, const TriangleTree& tree,
                                     const DepthRange& range, Comm* comm = nullptr);

} // namespace hyoryu
