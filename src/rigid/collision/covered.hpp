// SPDX-License-Identifier: MIT
// Contacts in concave corners (those of meshes and compounds), where each face ends at the other.
#pragma once

#include "feature.hpp"

#include <vector>

namespace hyoryu {

/// In a deep overlap at a concave corner all contacts are covered by another face. Appends those of
/// `covered` that overlap by more than `depth` to `found`, shallowest first, unless an open contact
/// (in `found`, from `first` on) or an appended one near them already represents the overlap.
void add_covered(std::vector<Candidate>& covered, double depth, std::size_t first,
                 std::vector<Candidate>& found);

} // namespace hyoryu
