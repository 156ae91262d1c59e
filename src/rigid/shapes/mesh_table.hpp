// SPDX-License-Identifier: MIT
// A triangle surface with the tables that contact needs.
#pragma once

#include "hyoryu/rigid/box_tree.hpp"

#include "hyoryu/rigid/body.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace hyoryu {

/// Connected triangles in one plane. A contact belongs to the patch and not to the triangle, so
/// that a body that slides over the patch does not collide with its inner edges.
struct Patch {
    Vec3 normal{0, 0, 1}; // unit, out of the solid
    double offset = 0;    // normal . x of the plane [m]
};

/// A triangle moved into the plane of its patch.
struct FlatTriangle {
    int patch = 0;
    std::array<int, 3> corner{};
    std::array<int, 3> crease{};  // of the edge from corner k to k + 1; -1: flat or concave
    std::array<Vec3, 3> point;    // [m]
    std::array<Vec3, 3> sideways; // unit, in the plane, out of the triangle across edge k
};

/// How far the foot of a point on the plane of a triangle is past its sides; negative inside [m].
inline double past_sides(const FlatTriangle& t, const Vec3& p)
{
    double past = -infinity;
    for (std::size_t k = 0; k < 3; ++k) {
        past = std::max(past, t.sideways[k].dot(p - t.point[k]));
    }
    return past;
}

/// A convex edge between two patches, or the rim of an open surface: only these have normals of
/// their own, the cone between those of the patches.
struct Crease {
    int i = 0, j = 0;             // corners
    Vec3 left{0, 0, 0};           // unit, across the edge into the first patch
    Vec3 right{0, 0, 0};          // into the second one; the same as left at a rim
    Vec3 outward = Vec3::UnitZ(); // into the middle of the cone of normals, any length
};

/// A corner of the mesh; only where creases meet at an angle it can touch by itself.
struct MeshCorner {
    Vec3 point{0, 0, 0};      // [m]
    int first = 0, count = 0; // of the corners along its edges, in `MeshTable::neighbours`
    bool sharp = false;
};

/// All tables, in world axes at time 0.
struct MeshTable {
    std::vector<Patch> patches;
    std::vector<FlatTriangle> triangles;
    std::vector<Crease> creases;
    std::vector<MeshCorner> corners;
    std::vector<int> neighbours; // corners along the edges of each corner, one after the other
    BoxTree tree;                // of the triangles
};

MeshTable mesh_table(const MeshSurface& surface);

/// Whether a unit vector lies in the cone of normals of a crease or corner, with a slack that
/// covers what round-off does to features that lie flat on each other.
bool in_cone(const Crease& crease, const Vec3& n);
bool in_cone(const MeshTable& mesh, const MeshCorner& corner, const Vec3& n);

} // namespace hyoryu
