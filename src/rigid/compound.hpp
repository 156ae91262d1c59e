// SPDX-License-Identifier: MIT
// Solids made of several convex parts.
#pragma once

#include "mesh_axis.hpp"

#include <span>

namespace hyoryu {

/// The tables of a compound in three dimensions.
Solid compound_solid(const Compound& shape);

/// The convex parts: those of a compound, or the solid itself.
std::span<const Solid> convex_parts(const Solid& solid);

/// The part that has a corner, by its number in the whole.
const Solid& part_of_corner(const Solid& solid, int corner);

/// Whether the surface of a compound goes through face f of one of its parts at a point of that
/// face (body frame), or the face is covered there by another part. At the rim of an open region
/// the face is open.
bool face_is_open(const Solid& whole, const Solid& part, int f, const Vec3& point);

/// Whether both faces beside an edge are open at a point of it: an edge within the surface, or in a
/// corner that looks inwards, has no normal of its own.
bool edge_is_open(const Solid& whole, const Solid& part, const Edge& edge, const Vec3& point);

/// Whether the point of a part that is nearest to something outside, in a direction n, can be
/// touched: its face is open there or, at an edge or corner, all faces are.
bool nearest_is_open(const Solid& whole, const Solid& part, const Vec3& point, const Vec3& n);

} // namespace hyoryu
