// SPDX-License-Identifier: MIT
// Rounding errors of single precision that the search for neighbours allows for.
#pragma once

namespace hyoryu {

/// Bound on the rounding error of positions and squared distances in single precision, relative to
/// the edge of a tile [1].
inline constexpr float rounding_of_positions = 2e-6F;

} // namespace hyoryu
