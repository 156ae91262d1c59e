// SPDX-License-Identifier: MIT
// Tolerances that several parts of the narrow phase share.
#pragma once

namespace hyoryu {

/// A point this part of the size of a pair past the rim of a face or the end of a feature still
/// counts as on it, so that flush faces keep their corners; points nearer to each other are one.
inline constexpr double rim_tolerance = 1e-6;

/// A rod stands on its rim rather than lies if its axis is nearer to the normal than acos of this.
inline constexpr double standing = 0.995;

/// What round-off does to the normal of a rim, or to an edge, that lies flat (unit vectors).
inline constexpr double lying_flat = 1e-6;

/// Sine of the angle below which two edges are parallel and their cross product is noise.
inline constexpr double parallel_edges = 1e-4;

/// Shorter than this a direction is noise and a fixed one takes its place (unit vectors).
inline constexpr double no_direction = 1e-9;

/// An overlap deeper than this was not located, and a body nearer than this may touch [units].
inline constexpr double deep = 1e-5;

} // namespace hyoryu
