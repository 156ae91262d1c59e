// SPDX-License-Identifier: MIT
// The hot loop of making neighbour lists: which points are near?
#pragma once

#include "hyoryu/core/compiled_sets.hpp"
#include "hyoryu/core/tiles.hpp"

namespace hyoryu {

/// Columns x, y, z of positions relative to the centre of a tile [m].
using FloatColumns = std::array<const float*, 3>;

/// What a block may meet: whole chunks and their bounds. Lanes of a chunk without a point, the
/// chunk behind the last one, and bounds behind the last up to `spare_chunks`, are far away.
struct Candidates {
    FloatColumns points; // eight a chunk
    FloatColumns low, high;
    std::int32_t chunks = 0;
};

/// How far the loops look and write behind the last chunk.
inline constexpr std::size_t spare_chunks = 16;

struct ListLoops {
    /// Writes the numbers of the candidates within the radius of a point to `number`, ascending;
    /// returns how many. `near` has room for all chunks and `spare_chunks` more, `number` for all
    /// candidates and two chunks more.
    std::size_t (*filter)(const Candidates& all, const std::array<float, 3>& point, float radius,
                          std::int32_t* near, std::uint16_t* number);
};

/// The loops as compiled for one instruction set.
template <int bytes>
const ListLoops* list_loops();

} // namespace hyoryu
