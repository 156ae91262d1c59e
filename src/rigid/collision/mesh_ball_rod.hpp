// SPDX-License-Identifier: MIT
// Balls and rods against a triangle surface.
#pragma once

#include "narrow_phase.hpp"

namespace hyoryu {

/// Appends the features of a ball or a rod and the triangles within its bounding box. Both are
/// exact: a ball by its nearest point on every triangle, a rod by the low points of its rims and by
/// its nearest point on every crease.
void find_round_on_mesh(const BodyPair& pair, const Configuration& at,
                        std::vector<Candidate>& found);

} // namespace hyoryu
