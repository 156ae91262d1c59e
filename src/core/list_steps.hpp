// SPDX-License-Identifier: MIT
// A byte an entry: from the numbers of neighbours to the steps between them.
#pragma once

#include "hyoryu/core/tiles.hpp"

namespace hyoryu {

/// One in so many chunks that a block looks at is nothing, so that a step of one byte leads from
/// any number to the first slot of a chunk that is nothing, and from there to any before the next
/// such.
inline constexpr int nothing_period = 31;

/// How many steps are made together.
inline constexpr std::size_t steps_together = 16;

/// Writes steps to ascending numbers, the first one from itself, and fills up to packs of `lanes`
/// with what is nothing; returns how many. Between numbers that are too far apart for one step
/// stand entries that are nothing. Of so many `chunks` the last is nothing, too. Behind the numbers
/// there is room for `steps_together` more, and `step` has room for as many steps as there are
/// slots, a pack and `steps_together` more.
std::size_t write_steps(std::uint16_t* number, std::size_t count, std::size_t chunks, int lanes,
                        std::uint8_t* step);

} // namespace hyoryu
