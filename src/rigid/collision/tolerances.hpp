// SPDX-License-Identifier: MIT
// Tolerances that several parts of the narrow phase share.
#pragma once

namespace hyoryu {

/// Distance past the rim of a face or the end of a feature within which a point counts as on it,
/// relative to the size of the pair, so that flush faces keep their corners; nearer points are
/// merged.
inline constexpr double rim_tolerance = 1e-6;

/// A rod stands on its rim rather than lies if its axis is nearer to the normal than acos of this.
inline constexpr double standing = 0.995;

/// Round-off of the normal of a rim or edge that lies flat on a face (unit vectors).
inline constexpr double lying_flat = 1e-6;

/// Sine of the angle below which two edges are parallel and their cross product is noise.
inline constexpr double parallel_edges = 1e-4;

/// A vector shorter than this has no direction; a fixed one replaces it (unit vectors).
inline constexpr double no_direction = 1e-9;

/// An overlap deeper than this was not located, and a body nearer than this may touch [units].
inline constexpr double deep = 1e-5;

} // namespace hyoryu
