// SPDX-License-Identifier: MIT
// Convex parts of solids by their support functions, and how deep two of them overlap.
//
// For a unit direction n let f(n) be how far A reaches beyond B along n: A moved back by f(n) n is
// free of B, so *every* f(n) is an upper bound of the depth of their overlap, the smallest f is the
// depth, and where it is negative the parts are apart. The witness looks for the smallest f from
// several directions and so can tell an overlap too large, never too small.
#pragma once

#include "scene.hpp"

#include <span>

namespace witness {

/// A convex set in the axes of its solid: the hull of its corners, a cylinder about the x axis, or
/// either with a margin of `radius` around (a ball is a point with a margin).
struct Convex {
    std::vector<Vec3> corners;
    double radius = 0;          // margin [m]
    Vec3 middle{0, 0, 0};       // of the cylinder, and a point inside any part
    double cylinder_radius = 0; // 0: the hull of the corners
    double half_length = 0;     // of the cylinder
    std::vector<Vec3> normals;  // directions worth a look: normals of faces, both ways
    std::vector<Vec3> edges;    // directions whose cross products with those of another are as well
    double reach = 0;           // distance from `middle` that no point exceeds
    Vec3 box{0, 0, 0};          // edges, if it is a box about `middle`
    std::vector<std::array<int, 3>> faces; // of its corners, if it is the hull of a mesh
};

/// A part in space.
struct Placed {
    const Convex* part = nullptr;
    Mat3 turn = Mat3::Identity();
    Vec3 origin{0, 0, 0}; // of the solid's axes
    Vec3 middle() const { return origin + turn * part->middle; }
};

/// The parts of a body or solid wall, in its own axes. A mesh that is not convex is the cells of
/// its lattice at the spacing of its particles, as the documentation of bodies says; that of a wall
/// has no parts.
std::vector<Convex> parts_of(const Solid& solid, int dimensions);

/// Whether a closed mesh is its own hull but for round-off of single precision.
bool is_convex(const Mesh& mesh);

/// The hull of the corners of a convex mesh.
Convex hull_of(const Mesh& mesh);

/// A box from its corners.
Convex box_between(const Vec3& low, const Vec3& high, int dimensions);

/// A triangle without thickness.
Convex triangle_of(const Vec3& a, const Vec3& b, const Vec3& c);

/// The farthest point of a part along n, without its margin.
Vec3 core_support(const Placed& placed, const Vec3& n);

/// How far the part reaches along n, from the origin of space [m].
double reach_along(const Placed& placed, const Vec3& n);

struct Depth {
    double value = 0;     // upper bound of the depth [m]; minus the distance where they are apart
    Vec3 normal{0, 0, 0}; // from A to B: A moved by -value times it touches B
};

/// The overlap of A with B. `warm` is a direction to begin with, or zero. Once a direction bounds
/// the overlap below `enough` none deeper is looked for.
Depth overlap(const Placed& a, const Placed& b, const Vec3& warm, double enough);

/// Overlaps below this are not told from none [m]: round-off of positions of some metres, and of
/// the search.
constexpr double negligible = 1e-9;

} // namespace witness
