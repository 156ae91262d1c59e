// SPDX-License-Identifier: MIT
// Solids made of several convex parts: their tables, and tests whether a face or edge of a part
// lies on the surface of the compound ("open") or is covered by another part.
#pragma once

#include "solid.hpp"

#include <span>

namespace hyoryu {

/// The tables of a compound in three dimensions.
Solid compound_solid(const Compound& shape, int dimensions);

/// The convex parts: those of a compound, or the solid itself.
std::span<const Solid> convex_parts(const Solid& solid);

/// The part that has a corner, by its number in the whole.
const Solid& part_of_corner(const Solid& solid, int corner);

/// Whether the surface of a compound goes through face f of one of its parts at a point of that
/// face (body frame), or the face is covered there by another part. At the rim of an open region
/// the face is open.
bool face_is_open(const Solid& whole, const Solid& part, int f, const Vec3& point);

/// Overlap in a concave corner beyond which each part may cover the faces of the other [m].
double depth_of_cover(const Solid& whole);

/// Whether both faces beside an edge are open at a point of it: an edge within the surface or in a
/// concave corner has no normals of its own.
bool edge_is_open(const Solid& whole, const Solid& part, const Edge& edge, const Vec3& point);

/// The face of a part that contains the point and has the normal n; -1 if there is none, as on an
/// edge or corner.
int face_at(const Solid& whole, const Solid& part, const Vec3& point, const Vec3& n);

/// Whether all faces of a part at a point of an edge or corner are open there.
bool rim_is_open(const Solid& whole, const Solid& part, const Vec3& point);

} // namespace hyoryu
