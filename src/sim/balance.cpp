// SPDX-License-Identifier: MIT
#include "hyoryu/sim/balance.hpp"

#include "hyoryu/ranks/comm.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace hyoryu {

namespace {

// Cuts stay while the longest working time is at most this multiple of the mean. Chosen, not
// measured.
constexpr double tolerated = 1.05;
// New cuts must reduce the longest working time to this part of it. Parts are whole tiles, so that
// in a small case no cut is even. Chosen, not measured.
constexpr double worthwhile = 0.97;

struct TileWeight {
    std::uint64_t tile = 0;
    double weight = 0;
};

// Adds the entries of a list to the weights of its own tiles.
void add_entries(const PairList& list, const Tiles& tiles, std::map<std::uint64_t, double>& weight)
{
    for (const ListBlock& block : list.blocks()) {
        const auto after = std::upper_bound(tiles.start.begin(), tiles.start.end(),
                                            block.first - tiles.first_slot);
        double entries = 0;
        for (std::int32_t k = 0; k < block.last - block.first; ++k) {
            entries += list.lanes() * block.list[k].packs;
        }
        weight[tiles.tile[at(after - tiles.start.begin() - 1)]] += entries;
    }
}

// The weights of the tiles of this rank, which add up to `work`.
std::vector<TileWeight> own_weights(const Fluid& fluid, double work)
{
    // Work for a particle besides its pairs, in list entries. An estimate: it moves cuts, and no
    // result depends on them.
    constexpr double particle = 10;
    const FluidNeighbours& n = fluid.neighbours;
    std::map<std::uint64_t, double> weight;
    for (std::size_t t = 0; t < n.fluid.tile.size(); ++t) {
        weight[n.fluid.tile[t]] += particle * (n.fluid.start[t + 1] - n.fluid.start[t]);
    }
    add_entries(n.fluid_fluid, n.fluid, weight);
    add_entries(n.fluid_solid, n.fluid, weight);
    add_entries(n.wall_fluid, n.wall, weight);
    add_entries(n.wall_body, n.wall, weight);
    add_entries(n.body_fluid, n.body, weight);
    add_entries(n.body_solid, n.body, weight);
    double sum = 0;
    for (const auto& [tile, entries] : weight) {
        sum += entries;
    }
    std::vector<TileWeight> all;
    for (const auto& [tile, entries] : weight) {
        all.push_back({tile, entries * work / sum});
    }
    return all;
}

// The work of the rank that has most of it, with such cuts.
double longest(const Cuts& cuts, std::span<const std::uint64_t> tiles,
               std::span<const double> weights)
{
    std::vector<double> of_ranks(at(cuts.ranks()), 0);
    for (std::size_t k = 0; k < tiles.size(); ++k) {
        of_ranks[at(cuts.owner(tiles[k]))] += weights[k];
    }
    return *std::ranges::max_element(of_ranks);
}

} // namespace

void balance(Simulation& sim, Balance& balance, double busy)
{
    if (!sim.fluid || !sim.fluid->ghosts || balance.every <= 0 ||
        sim.clock.step % balance.every != 0) {
        return;
    }
    Ghosts& ghosts = *sim.fluid->ghosts;
    const double work = busy - std::exchange(balance.busy, busy);
    const std::vector<double> of_ranks = gather(ghosts.comm, std::span(&work, 1)).all;
    const double mean = std::accumulate(of_ranks.begin(), of_ranks.end(), 0.0) /
                        static_cast<double>(of_ranks.size());
    const double longest_now = *std::ranges::max_element(of_ranks);
    balance.imbalance = mean > 0 ? longest_now / mean : 1;
    if (balance.imbalance <= tolerated) {
        return;
    }
    const std::vector<TileWeight> own = own_weights(*sim.fluid, work);
    std::vector<std::uint64_t> tiles;
    std::vector<double> weights;
    for (const TileWeight& w : gather(ghosts.comm, std::span<const TileWeight>(own)).all) {
        tiles.push_back(w.tile);
        weights.push_back(w.weight);
    }
    const Cuts next = cut_evenly(tiles, weights, ghosts.comm.size());
    if (longest(next, tiles, weights) < worthwhile * longest_now) {
        ghosts.next_cuts = next;
        balance.moves += 1;
    }
}

} // namespace hyoryu
