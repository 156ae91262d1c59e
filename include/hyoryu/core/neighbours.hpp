// SPDX-License-Identifier: MIT
// Neighbour lists: for each point of a destination the points of a source within a radius, a skin
// included, so that a list serves several steps.
#pragma once

#include "hyoryu/core/instruction_set.hpp"
#include "hyoryu/core/tiles.hpp"

#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace hyoryu {

/// Points among which neighbours are looked for. Those that another process owns stand in tiles of
/// their own; a tile is whole in one of the two.
struct ListSource {
    const Tiles* own = nullptr;
    const Tiles* ghosts = nullptr; // null where this process has all

    ListSource(const Tiles* own_, const Tiles* ghosts_ = nullptr) : own(own_), ghosts(ghosts_) {}
};

/// What is left out of neighbour lists. An empty span leaves out nothing.
struct ListChoice {
    std::span<const std::int32_t> owner = {};  // by slot: neighbours of the same owner (a body)
    Index first_owner = 0;                     // the slot at which `owner` begins
    std::span<const std::uint8_t> wanted = {}; // by slot: those marked 0 get no neighbours
};

/// Eight slots that a block looks at, and the way from their tile to that of the block.
struct SourceChunk {
    std::int32_t slot;               // the first
    std::array<std::int8_t, 3> step; // in edges of a tile
    std::uint8_t count;              // slots that belong to it; none: the chunk is nothing
};

/// Where the numbers of a list begin, and how long it is.
struct ListHead {
    std::uint16_t start;
    std::uint16_t packs;
};

/// The lists of some slots of one tile. The slots of the chunks are numbered, eight a chunk, and an
/// entry is the step to its number from that of the entry before it, or from the start of its list.
/// Every list is filled up to whole packs with the first slot of a chunk that is nothing.
struct ListBlock {
    std::int32_t first = 0; // destination slots [first, last)
    std::int32_t last = 0;
    std::int32_t chunks = 0;
    const SourceChunk* chunk = nullptr;
    const std::uint8_t* entry = nullptr; // list after list
    const ListHead* list = nullptr;
};

/// Memory in pages that is given back all at once; pages stay for the next time.
class PageStore {
public:
    void reset();
    /// Room for so many bytes, aligned to 16. Any thread may ask.
    std::byte* take(std::size_t bytes);
    /// Adds a block whose lists are in the store. Any thread may ask; the order is any.
    void append(const ListBlock& block, std::vector<ListBlock>& blocks);
    /// Gives back the pages that nothing was put into, but for an eighth of the filled ones and one
    /// more: room for lists that grow, not for the longest that ever were.
    void trim();
    std::size_t bytes() const;

private:
    struct Page {
        std::unique_ptr<std::byte[]> memory;
        std::size_t size = 0;
        std::size_t used = 0;
    };
    static constexpr std::size_t page_size = std::size_t(1) << 20;

    std::mutex one_at_a_time_;
    std::vector<Page> pages_;
    std::size_t current_ = 0;
};

/// What one thread needs to make the lists of a block; kept from one time to the next.
struct ListShop {
    std::vector<SourceChunk> chunks;
    std::array<std::vector<float>, 3> points, low, high; // x, y, z
    std::vector<std::int32_t> near;
    std::vector<std::uint16_t> numbers; // of one list
    std::vector<std::uint8_t> entries;
    std::vector<ListHead> lists;

    std::size_t bytes() const;
};

/// Lists of one pair kind (destination <- source). Blocks are built in parallel and own their
/// entries; slots without neighbours, such as dry walls, are in no block.
class PairList {
public:
    /// How the lists are made: the radius of pairs, lanes of a pack and instruction set.
    struct Settings {
        real radius = 0; // [m]
        int lanes = 1;
        InstructionSet set = InstructionSet::baseline;
    };
    /// Points of a slot are listed source by source; a point of the source is its own neighbour,
    /// as kernel sums want it and differences do not mind.
    void build(const Tiles& destination, std::span<const ListSource> sources,
               const Settings& settings, const ListChoice& choice = {});
    /// Which slots stand in any list; what has met nothing needs no list of its own.
    void mark_met(std::vector<std::uint8_t>& marks) const;
    /// Marks the slots >= `first` in the chunks of any block, whether they are neighbours or not.
    /// `marks[k]` belongs to slot `first` + k.
    void mark_looked_at(std::vector<std::uint8_t>& marks, Index first) const;
    void clear();
    /// Reorders the blocks: those without a chunk at or behind slot `first` come first. Returns the
    /// number of these.
    Index split(Index first);

    std::span<const ListBlock> blocks() const { return blocks_; }
    bool empty() const { return blocks_.empty(); }
    int lanes() const { return lanes_; }
    /// Largest number of chunks that a block looks at.
    std::int32_t most_chunks() const;
    /// Entries including those that are nothing, and bytes held, room for making them included.
    Index entries() const;
    std::size_t bytes() const;

    /// Calls f(i, j) for the slots of every pair; what is nothing is left out.
    void for_each_pair(auto&& f) const
    {
        for (const ListBlock& block : blocks_) {
            for_each_pair_of(block, f);
        }
    }

private:
    void for_each_pair_of(const ListBlock& block, const auto& f) const
    {
        const std::uint8_t* entry = block.entry;
        for (std::int32_t i = block.first; i < block.last; ++i) {
            const ListHead list = block.list[i - block.first];
            int number = list.start;
            for (int k = 0; k < lanes_ * list.packs; ++k) {
                number += *entry++;
                const SourceChunk& chunk = block.chunk[number / chunk_slots];
                if (number % chunk_slots < chunk.count) {
                    f(Index(i), Index(chunk.slot + number % chunk_slots));
                }
            }
        }
    }

    int lanes_ = 1;
    std::vector<ListBlock> blocks_;
    std::vector<ListShop> shops_; // by thread
    std::unique_ptr<PageStore> store_ = std::make_unique<PageStore>();
};

} // namespace hyoryu
