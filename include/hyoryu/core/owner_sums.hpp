// SPDX-License-Identifier: MIT
// Sums over the points of each owner, such as the forces on each wall, in parallel over tiles. The
// result does not depend on the number of threads or the order of the rows, bit for bit: the terms
// of a run of slots of one owner within a tile are added as plain numbers, the runs in fixed point.
#pragma once

#include "hyoryu/core/fixed_sum.hpp"

#include <vector>

namespace hyoryu {

/// Sums of n numbers for each owner; its memory is reused from step to step.
template <std::size_t n>
class OwnerSums {
public:
    /// Sets the sums of all owners to zero.
    void begin(std::size_t owners, const FixedUnits<n>& units)
    {
        units_ = units;
        by_thread_.resize(static_cast<std::size_t>(thread_count()));
        for (std::vector<FixedSums<n>>& sums : by_thread_) {
            sums.assign(owners, {});
        }
    }

    /// Adds the terms of the points of a tile, `owner_of(row)` and `term(row)`. Called from a
    /// parallel loop over tiles.
    void add_tile(const Tiles& tiles, Index tile, const auto& owner_of, const auto& term)
    {
        const auto t = static_cast<std::size_t>(tile);
        const auto row_at = [&](std::int32_t slot) { return tiles.row[slot]; };
        std::vector<FixedSums<n>>& sums = by_thread_[worker()];
        std::array<double, n> run{};
        std::size_t owner = owner_of(row_at(tiles.start[t]));
        for (std::int32_t slot = tiles.start[t]; slot < tiles.start[t + 1]; ++slot) {
            const std::size_t next = owner_of(row_at(slot));
            if (next != owner) {
                sums[owner].add(run, units_);
                run = {};
                owner = next;
            }
            const std::array<double, n> own = term(row_at(slot));
            for (std::size_t k = 0; k < n; ++k) {
                run[k] += own[k];
            }
        }
        sums[owner].add(run, units_);
    }

    /// Adds a term of an owner, from any thread of a parallel loop.
    void add(std::size_t owner, const std::array<double, n>& term)
    {
        by_thread_[worker()][owner].add(term, units_);
    }

    /// Ends the summation: adds up the partial sums of the threads. Returns the sums of each owner,
    /// to which those of other processes may be added.
    std::span<FixedSums<n>> end()
    {
        std::vector<FixedSums<n>>& all = by_thread_.front();
        for (std::size_t thread = 1; thread < by_thread_.size(); ++thread) {
            for (std::size_t owner = 0; owner < all.size(); ++owner) {
                all[owner].add(by_thread_[thread][owner]);
            }
        }
        return all;
    }
    std::size_t owners() const { return by_thread_.empty() ? 0 : by_thread_.front().size(); }
    /// The sums of an owner, after `end`.
    std::array<double, n> of(std::size_t owner) const
    {
        return by_thread_.front()[owner].values(units_);
    }

private:
    FixedUnits<n> units_;
    std::vector<std::vector<FixedSums<n>>> by_thread_;
};

} // namespace hyoryu
