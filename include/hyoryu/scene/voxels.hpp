// SPDX-License-Identifier: MIT
// Cells of a lattice as boxes.
#pragma once

#include "hyoryu/scene/shapes.hpp"

#include <optional>

namespace hyoryu {

/// The union of equal axis-aligned cells about the points, as boxes that do not overlap: greedily
/// grown along x, then y, then z. None if the points do not lie on one lattice of that cell within
/// 1e-6 of it, or if two of them are in one place. A union of such cells is convex if and only if
/// it is one box.
std::optional<std::vector<Bounds>> merged_cells(const std::vector<Vec3>& points, const Vec3& cell);

/// Number of points that have not all six neighbours on their lattice.
Index exposed_cells(const std::vector<Vec3>& points, const Vec3& cell);

} // namespace hyoryu
