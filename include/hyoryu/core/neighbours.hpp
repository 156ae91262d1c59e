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

/// The points of one kind in which neighbours are searched. The points of other processes (ghosts)
/// have tiles of their own; each tile belongs entirely to one of the two sets.
struct ListSource {
    const Tiles* own = nullptr;
    const Tiles* ghosts = nullptr; // null if this process owns all points

    ListSource(const Tiles* own_, const Tiles* ghosts_ = nullptr) : own(own_), ghosts(ghosts_) {}
};

/// Pairs and points that neighbour lists exclude. An empty span excludes nothing.
struct ListChoice {
    std::span<const std::int32_t> owner = {};  // by slot: neighbours of the same owner (a body)
    Index first_owner = 0;                     // the slot at which `owner` begins
    std::span<const std::uint8_t> wanted = {}; // by slot: a point marked 0 gets no list
};

/// Eight consecutive source slots of a block, and the offset of their tile from that of the block.
struct SourceChunk {
    std::int32_t slot;               // first slot
    std::array<std::int8_t, 3> step; // in edges of a tile
    std::uint8_t count;              // slots that hold a point; 0: a padding chunk
};

/// The first number of a list, and its length in packs.
struct ListHead {
    std::uint16_t start;
    std::uint16_t packs;
};

/// The lists of a range of slots of one tile. The slots of the chunks are numbered, eight to a
/// chunk. An entry is the difference between its number and that of the entry before it; the first
/// entry counts from the start of its list. Every list is padded to whole packs with the first slot
/// of a padding chunk, whose points are far from all others.
struct ListBlock {
    std::int32_t first = 0; // destination slots [first, last)
    std::int32_t last = 0;
    std::int32_t chunks = 0;
    const SourceChunk* chunk = nullptr;
    const std::uint8_t* entry = nullptr; // list after list
    const ListHead* list = nullptr;
};

/// An arena allocator: `reset` releases all blocks at once and keeps the pages for reuse.
class PageStore {
public:
    void reset();
    /// Allocates the given number of bytes, aligned to 16. Thread-safe.
    std::byte* take(std::size_t bytes);
    /// Appends a block whose lists are in the store. Thread-safe; the order of the blocks is
    /// unspecified.
    void append(const ListBlock& block, std::vector<ListBlock>& blocks);
    /// Frees unused pages except a reserve of one page and an eighth of the filled ones.
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

/// Scratch memory of one thread for building the lists of a block; reused by later builds.
struct ListScratch {
    std::vector<SourceChunk> chunks;
    std::array<std::vector<float>, 3> points, low, high; // x, y, z
    std::vector<std::int32_t> near;
    std::vector<std::uint16_t> numbers; // of one list
    std::vector<std::uint8_t> entries;
    std::vector<ListHead> lists;

    std::size_t bytes() const;
};

/// Lists of one pair kind (destination <- source). Blocks are built in parallel and own their
/// entries; slots without neighbours, such as walls away from fluid, are in no block.
class PairList {
public:
    /// How the lists are made: the radius of pairs, lanes of a pack and instruction set.
    struct Settings {
        real radius = 0; // [m]
        int lanes = 1;
        InstructionSet set = InstructionSet::baseline;
    };
    /// Builds the lists. The neighbours of a point are listed source by source. A point that is in
    /// both sets is its own neighbour: kernel sums need this term, sums of differences ignore it.
    void build(const Tiles& destination, std::span<const ListSource> sources,
               const Settings& settings, const ListChoice& choice = {});
    /// Marks the slots that are a neighbour in some list; the others need no list of their own.
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
    /// Number of entries including padding; bytes held including scratch memory.
    Index entries() const;
    std::size_t bytes() const;

    /// Calls f(i, j) for the slots of every pair; padding is skipped.
    void for_each_pair(auto&& f) const
    {
        for (const ListBlock& block : blocks_) {
            for_each_pair_of(block, f);
        }
    }

    /// The same for the pairs of one block; those of a slot i are all in one.
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

private:
    int lanes_ = 1;
    std::vector<ListBlock> blocks_;
    std::vector<ListScratch> scratches_; // by thread
    std::unique_ptr<PageStore> store_ = std::make_unique<PageStore>();
};

} // namespace hyoryu
