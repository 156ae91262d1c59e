// SPDX-License-Identifier: MIT
// Marks the points of one set that have a point of another set within a radius. The search for a
// point ends at the first neighbour found, whereas neighbour lists contain all of them.
#pragma once

#include "hyoryu/core/tiles.hpp"

namespace hyoryu {

/// Sets the mark of every point of `points`, by slot from 0 on, that has a point of `others` within
/// `radius` [m], which must not exceed the edge of a tile; other marks stay. Points of `others`
/// whose entry in `counted` is 0 are passed over; where that is empty, none is. Both sets have the
/// same lattice. Within the rounding of single precision a point counts as near.
void mark_near(const Tiles& points, const Tiles& others, std::span<const std::uint8_t> counted,
               real radius, std::span<std::uint8_t> marks);

} // namespace hyoryu
