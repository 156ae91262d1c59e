// SPDX-License-Identifier: MIT
// The inner loop of building neighbour lists: a distance test of one point against all candidates.
#pragma once

#include "hyoryu/core/compiled_sets.hpp"
#include "hyoryu/core/tiles.hpp"

namespace hyoryu {

/// Columns x, y, z of positions relative to the centre of a tile [m].
using FloatColumns = std::array<const float*, 3>;

/// The candidates of a block: whole chunks and their bounds. Lanes of a chunk without a point, the
/// chunk behind the last one, and the bounds of `spare_chunks` chunks behind it lie far away.
struct Candidates {
    FloatColumns points; // eight per chunk
    FloatColumns low, high;
    std::int32_t chunks = 0;
};

/// Number of chunks behind the last one that the loops may read and write.
inline constexpr std::size_t spare_chunks = 16;

struct ListLoops {
    /// Writes the numbers of the candidates within the radius of a point to `number`, ascending;
    /// returns their count. `near` must hold all chunks and `spare_chunks` more, `number` all
    /// candidates and the slots of two more chunks.
    std::size_t (*filter)(const Candidates& all, const std::array<float, 3>& point, float radius,
                          std::int32_t* near, std::uint16_t* number);
};

/// The loops as compiled for one instruction set.
template <int bytes>
const ListLoops* list_loops();

} // namespace hyoryu
