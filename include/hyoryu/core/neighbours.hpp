// SPDX-License-Identifier: MIT
// Neighbour lists: for each row of a destination the rows of a source within a radius, a skin
// included, so that a list serves several steps.
#pragma once

#include "hyoryu/core/cell_grid.hpp"
#include "hyoryu/core/parallel.hpp"
#include "hyoryu/core/particles.hpp"

#include <span>
#include <vector>

namespace hyoryu {

/// What is left out of neighbour lists. An empty span leaves out nothing.
struct ListChoice {
    std::span<const std::int32_t> owner = {};  // neighbours of the row's own owner (one rigid body)
    std::span<const std::uint8_t> wanted = {}; // rows marked 0 get no neighbours
};

/// Lists of one pair kind (destination <- source). Rows are kept in blocks, each with its own
/// storage, so that blocks are built in parallel and no entry is ever moved. Every list is filled
/// up to whole packs with the void row, which is far from everything.
class PairList {
public:
    static constexpr Index block_rows = 128;

    /// `x`: positions of all rows. Neighbours of a row are listed grid by grid in the order of the
    /// cells; a row of the source is its own neighbour, as kernel sums want it and differences do
    /// not mind.
    void build(std::span<const Vec3> x, Rows destination, std::span<const CellGrid* const> sources,
               real radius, const ListChoice& choice = {});
    /// Which rows stand in any list, by row; what has met nothing needs no list of its own.
    std::vector<std::uint8_t> met(Index all_rows) const;
    void clear();

    Rows rows() const { return rows_; }
    bool empty() const { return rows_.size() == 0; }
    /// Neighbours of a row; a multiple of `lanes` entries.
    std::span<const std::int32_t> operator[](Index row) const
    {
        const Index local = row - rows_.begin;
        const Block& block = blocks_[static_cast<std::size_t>(local / block_rows)];
        const auto k = static_cast<std::size_t>(local % block_rows);
        return std::span(block.entries)
            .subspan(static_cast<std::size_t>(block.start[k]),
                     static_cast<std::size_t>(block.start[k + 1] - block.start[k]));
    }
    /// Entries including padding, and bytes held.
    Index entries() const;
    std::size_t bytes() const;

private:
    struct Block {
        std::vector<std::int32_t> entries;
        std::array<std::int32_t, block_rows + 1> start{};
    };
    Rows rows_;
    std::vector<Block> blocks_;
};

} // namespace hyoryu
