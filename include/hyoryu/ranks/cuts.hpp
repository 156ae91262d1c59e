// SPDX-License-Identifier: MIT
// Domain decomposition: the owner of each place. A rank owns a range of the numbers of tiles, so
// that the particles of all ranks, one rank after the other, are in the order in which one process
// has them; every place of space has an owner, whether anything is there or not.
#pragma once

#include "hyoryu/ranks/comm.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace hyoryu {

/// Numbers of tiles [begin, end).
struct TileRange {
    std::uint64_t begin = 0;
    std::uint64_t end = ~std::uint64_t(0);

    bool holds(std::uint64_t tile) const { return tile >= begin && tile < end; }
};

/// The first number of every rank but rank 0, ascending. Ranks with an empty range are legal.
struct Cuts {
    std::vector<std::uint64_t> first;

    int ranks() const { return static_cast<int>(first.size()) + 1; }
    int owner(std::uint64_t tile) const;
    TileRange range(int rank) const;
};

/// Weights by tile [1].
using TileWeights = std::map<std::uint64_t, double>;

/// Cuts between the tiles of all ranks, so that these have about equal sums of weights; `own`: the
/// weights of this rank. Called by all ranks.
Cuts cut_evenly(Comm& comm, const TileWeights& own);

/// Cuts between tiles, ascending, so that the ranks have about equal sums of their weights [1].
Cuts cut_evenly(std::span<const std::uint64_t> tiles, std::span<const double> weights, int ranks);

} // namespace hyoryu
