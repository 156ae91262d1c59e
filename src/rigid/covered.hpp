// SPDX-License-Identifier: MIT
// Contacts in corners that look inwards, where each face ends at the other.
#pragma once

#include "feature.hpp"

#include <vector>

namespace hyoryu {

/// Where solids are deep in a corner that looks inwards, all contacts there are covered by another
/// face. Appends to `found`, from the shallowest on, those of `covered` that overlap by more than
/// `depth`, unless an open contact (of `found`, from `first` on) or an appended one beside them
/// shows it.
void add_covered(std::vector<Candidate>& covered, double depth, std::size_t first,
                 std::vector<Candidate>& found);

} // namespace hyoryu
