// SPDX-License-Identifier: MIT
// The hot loop of making neighbour lists: which points are near?
#pragma once

#include "hyoryu/core/compiled_sets.hpp"
#include "hyoryu/core/tiles.hpp"

namespace hyoryu {

/// What a block may meet: whole chunks, positions relative to the centre of its tile. Lanes of a
/// chunk without a point are far away.
struct Candidates {
    const float* x;
    const float* y;
    const float* z;
    const ChunkBox* box;
    std::int32_t chunks;
};

/// Up to eight points whose lists are made together.
struct Seekers {
    const float* x;
    const float* y;
    const float* z;
    int count;
    ChunkBox box;
};

struct ListLoops {
    /// Writes the entries of each seeker, filled up to packs of `lanes`, one after the other to
    /// `entry` and the packs of each to `packs`; returns the number of entries. There is room for
    /// all candidates of all seekers and a pack more for each, and for all chunks in `near`.
    int (*filter)(const Candidates& all, const Seekers& points, float radius, int lanes,
                  std::int32_t* near, std::uint16_t* entry, std::uint16_t* packs);
};

/// The loops as compiled for one instruction set.
template <int bytes>
const ListLoops* list_loops();

} // namespace hyoryu
