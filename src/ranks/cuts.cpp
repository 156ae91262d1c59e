// SPDX-License-Identifier: MIT
#include "hyoryu/ranks/cuts.hpp"

#include "hyoryu/core/error.hpp"

#include <algorithm>
#include <numeric>

namespace hyoryu {

int Cuts::owner(std::uint64_t tile) const
{
    return static_cast<int>(std::upper_bound(first.begin(), first.end(), tile) - first.begin());
}

TileRange Cuts::range(int rank) const
{
    TileRange range;
    if (rank > 0) {
        range.begin = first[rank - 1];
    }
    if (static_cast<std::size_t>(rank) < first.size()) {
        range.end = first[rank];
    }
    return range;
}

Cuts cut_evenly(std::span<const std::uint64_t> tiles, std::span<const double> weights, int ranks)
{
    expects(tiles.size() == weights.size() && ranks >= 1);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    Cuts cuts;
    double sum = 0;
    std::size_t next = 0;
    for (int rank = 1; rank < ranks; ++rank) {
        const double before = total * rank / ranks;
        while (next < tiles.size() && sum + weights[next] / 2 < before) {
            sum += weights[next++];
        }
        cuts.first.push_back(next < tiles.size() ? tiles[next] : TileRange{}.end);
    }
    return cuts;
}

Cuts cut_evenly(Comm& comm, const TileWeights& own)
{
    struct TileWeight {
        std::uint64_t tile;
        double weight;
    };
    std::vector<TileWeight> listed;
    for (const auto& [tile, weight] : own) {
        listed.push_back({tile, weight});
    }
    TileWeights all;
    for (const TileWeight& one : gather(comm, std::span<const TileWeight>(listed)).all) {
        all[one.tile] += one.weight;
    }
    std::vector<std::uint64_t> tiles;
    std::vector<double> weights;
    for (const auto& [tile, weight] : all) {
        tiles.push_back(tile);
        weights.push_back(weight);
    }
    return cut_evenly(tiles, weights, comm.size());
}

} // namespace hyoryu
