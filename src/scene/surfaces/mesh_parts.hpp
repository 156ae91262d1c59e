// SPDX-License-Identifier: MIT
// Faults of closed triangle surfaces of several parts.
#pragma once

#include "hyoryu/scene/shapes.hpp"

#include <optional>

namespace hyoryu {

/// Places of faults; empty where there are none.
struct PartFaults {
    /// The normals of a part point into it, and no other part is around it: volume and mass would
    /// subtract it. A cavity within another part is not a fault.
    std::optional<Vec3> inside_out;
    /// Two parts overlap, or one is within another: volume and mass would count the common space
    /// twice. Overlaps thinner than a thousandth of the extent of the mesh are not looked for.
    std::optional<Vec3> overlap;
};

/// Overlaps cost a search between the parts.
enum class PartsAsked { all, inside_out };

/// Judges by the winding number (Jacobson et al. 2013): 1 just behind each triangle, and at most 1
/// in the common bounding boxes of two parts. Nothing is looked for in a connected mesh.
PartFaults part_faults(const MeshShape& mesh, PartsAsked asked = PartsAsked::all);

} // namespace hyoryu
