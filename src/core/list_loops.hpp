// SPDX-License-Identifier: MIT
// The hot loop of making neighbour lists: which points are near?
#pragma once

#include "hyoryu/core/compiled_sets.hpp"
#include "hyoryu/core/tiles.hpp"

namespace hyoryu {

/// Columns x, y, z of positions relative to the centre of a tile [m].
using FloatColumns = std::array<const float*, 3>;

/// What a block may meet: whole chunks and their bounds. Lanes of a chunk without a point, and
/// bounds behind the last chunk up to eight, are far away.
struct Candidates {
    FloatColumns points; // eight a chunk
    FloatColumns low, high;
    std::int32_t chunks = 0;
};

struct ListLoops {
    /// Writes the numbers of the candidates within the radius of a point to `entry`, filled up to
    /// packs of `lanes` with the number behind the last; returns how many. `near` has room for all
    /// chunks and eight more, `entry` for all candidates, a pack and eight more.
    int (*filter)(const Candidates& all, const std::array<float, 3>& point, float radius, int lanes,
                  std::uint16_t* near, std::uint16_t* entry);
};

/// The loops as compiled for one instruction set.
template <int bytes>
const ListLoops* list_loops();

} // namespace hyoryu
