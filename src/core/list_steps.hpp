// SPDX-License-Identifier: MIT
// Delta coding of neighbour lists: the ascending numbers of the neighbours of a point are stored as
// differences ("steps") of one byte each.
#pragma once

#include "hyoryu/core/tiles.hpp"

namespace hyoryu {

/// Every 31st chunk of a block is a padding chunk, so that a step of one byte leads from any number
/// to the first slot of a padding chunk, and from there to any number before the next padding
/// chunk.
inline constexpr int padding_period = 31;

/// Number of steps that are computed in one vector operation.
inline constexpr std::size_t steps_together = 16;

/// Encodes ascending numbers as steps; the first step is 0. The list is padded to whole packs of
/// `lanes`; returns the number of steps. Where two numbers are too far apart for one step, entries
/// of padding chunks stand between them. The last of the `chunks` must be a padding chunk too.
/// `number` needs room for `steps_together` more numbers behind the given ones; `step` needs room
/// for one step per slot, one pack and `steps_together` more.
std::size_t write_steps(std::uint16_t* number, std::size_t count, std::size_t chunks, int lanes,
                        std::uint8_t* step);

} // namespace hyoryu
