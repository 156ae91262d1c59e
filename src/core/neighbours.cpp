// SPDX-License-Identifier: MIT
// Builds neighbour lists tile by tile: chunks of eight points within the radius of the bounds of a
// tile are collected as candidates, then each point is tested against these candidates.
#include "hyoryu/core/neighbours.hpp"

#include "chunk_boxes.hpp"
#include "hyoryu/core/parallel.hpp"
#include "list_loops.hpp"
#include "list_steps.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>

namespace hyoryu {

namespace {

const ListLoops* loops_of(InstructionSet set)
{
    return table_of(
        set, []<int bytes>(RegisterSizes<bytes>) { return list_loops<bytes>(); }, CompiledSets{});
}

// Largest number of chunks whose slots can be numbered with 16 bits.
constexpr std::size_t most_chunks_of_a_block = 65536 / chunk_slots;
// Coordinate of padding points: their squared distances are finite and exceed every radius.
constexpr float far = 1e15F;

// Makes the lists of the points of one tile.
class TileLister {
public:
    TileLister(const Tiles& destination, std::span<const ListSource> sources,
               const PairList::Settings& settings, const ListChoice& choice, ListScratch& scratch,
               PageStore& store, std::vector<ListBlock>& out)
        : destination_(destination), sources_(sources), loops_(*loops_of(settings.set)),
          lanes_(settings.lanes), choice_(choice), scratch_(scratch), store_(store), out_(out)
    {
        const auto edge = static_cast<float>(destination.lattice.edge.maxCoeff());
        radius_ = static_cast<float>(settings.radius) + rounding_of_positions * edge;
    }

    void list(Index tile)
    {
        tile_ = tile;
        list_slots(destination_.start[at(tile)], destination_.start[at(tile + 1)]);
    }

private:
    bool wanted(Index k) const
    {
        return choice_.wanted.empty() || choice_.wanted[at(destination_.first_slot + k)] != 0;
    }
    bool any_wanted(Index first, Index last) const
    {
        for (Index k = first; k < last; ++k) {
            if (wanted(k)) {
                return true;
            }
        }
        return false;
    }
    ChunkBox box_of(Index chunk) const
    {
        return destination_.box[at(destination_.chunk_start[at(tile_)] + chunk)];
    }

    // Builds the lists of [first, last), or of its two halves if the candidates need more than 16
    // bits.
    void list_slots(Index first, Index last)
    {
        if (!any_wanted(first, last)) {
            return;
        }
        collect(first, last);
        if (scratch_.chunks.size() > most_chunks_of_a_block && last - first > chunk_slots) {
            const Index chunks = (last - first + chunk_slots - 1) / chunk_slots;
            const Index middle = first + chunks / 2 * chunk_slots;
            list_slots(first, middle);
            list_slots(middle, last);
            return;
        }
        expects(scratch_.chunks.size() <= most_chunks_of_a_block);
        const std::size_t entries = filter(first, last);
        if (entries > 0) {
            keep(first, last, entries);
        }
    }

    // Collects the source chunks that lie within the radius of the bounds of [first, last).
    void collect(Index first, Index last)
    {
        scratch_.chunks.clear();
        const Index start = destination_.start[at(tile_)];
        ChunkBox bounds = box_of((first - start) / chunk_slots);
        for (Index k = first; k < last; k += chunk_slots) {
            bounds = joined(bounds, box_of((k - start) / chunk_slots));
        }
        for (const ListSource& source : sources_) {
            destination_.lattice.for_beside(
                destination_.tile[at(tile_)],
                [&](std::uint64_t number, const std::array<int, 3>& way) {
                    collect_number(*source.own, number, way, bounds);
                    if (source.ghosts != nullptr) {
                        collect_number(*source.ghosts, number, way, bounds);
                    }
                });
        }
        add_padding();
    }

    void collect_number(const Tiles& source, std::uint64_t number, const std::array<int, 3>& way,
                        const ChunkBox& bounds)
    {
        const Index tile = source.find(number);
        if (tile >= 0) {
            collect_tile(source, tile, way, bounds);
        }
    }

    void collect_tile(const Tiles& source, Index tile, const std::array<int, 3>& way,
                      const ChunkBox& bounds)
    {
        const std::array<float, 3> step = step_to(source.lattice.edge, way);
        const Index end = source.start[at(tile + 1)];
        Index slot = source.start[at(tile)];
        const std::array columns{&source.x, &source.y, &source.z};
        for (Index chunk = source.chunk_start[at(tile)]; slot < end; ++chunk, slot += chunk_slots) {
            const ChunkBox box = shifted(source.box[at(chunk)], step);
            if (!is_near(box, bounds, radius_ * radius_)) {
                continue;
            }
            const Index count = std::min<Index>(chunk_slots, end - slot);
            if (scratch_.chunks.size() % padding_period == padding_period - 1) {
                add_padding();
            }
            const std::size_t place = add_box(box);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                float* const point = &scratch_.points[axis][chunk_slots * place];
                for (Index k = 0; k < count; ++k) {
                    point[k] = (*columns[axis])[at(slot + k)] + step[axis];
                }
            }
            scratch_.chunks.push_back(
                {static_cast<std::int32_t>(source.first_slot + slot),
                 {static_cast<std::int8_t>(way[0]), static_cast<std::int8_t>(way[1]),
                  static_cast<std::int8_t>(way[2])},
                 static_cast<std::uint8_t>(count)});
        }
    }

    // Appends the bounds of a chunk and sets its points to padding; returns the index of the chunk.
    std::size_t add_box(const ChunkBox& box)
    {
        const std::size_t place = scratch_.chunks.size();
        reserve(place + 1);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            scratch_.low[axis][place] = box.low[axis];
            scratch_.high[axis][place] = box.high[axis];
            std::fill_n(&scratch_.points[axis][chunk_slots * place], chunk_slots, far);
        }
        return place;
    }
    void add_padding()
    {
        add_box({{far, far, far}, {far, far, far}});
        scratch_.chunks.push_back({0, {0, 0, 0}, 0});
    }

    // Makes room for the given number of chunks and for the spare chunks that the loops read.
    void reserve(std::size_t chunks)
    {
        if (chunks + spare_chunks > scratch_.low[0].size()) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                scratch_.low[axis].resize(2 * (chunks + spare_chunks));
                scratch_.high[axis].resize(2 * (chunks + spare_chunks));
                scratch_.points[axis].resize(2 * chunk_slots * (chunks + spare_chunks));
            }
        }
    }

    // Builds the lists of [first, last); returns the number of their entries.
    std::size_t filter(Index first, Index last)
    {
        const std::size_t chunks = scratch_.chunks.size();
        for (std::vector<float>& low : scratch_.low) {
            std::fill_n(&low[chunks], spare_chunks, far);
        }
        const std::size_t room = chunk_slots * chunks + at(lanes_) + steps_together;
        scratch_.near.resize(std::max(scratch_.near.size(), chunks + spare_chunks));
        scratch_.numbers.resize(std::max(scratch_.numbers.size(), chunk_slots * (chunks + 2)));
        scratch_.lists.resize(std::max(scratch_.lists.size(), at(last - first)));
        const auto data = [](const std::array<std::vector<float>, 3>& columns) {
            return FloatColumns{columns[0].data(), columns[1].data(), columns[2].data()};
        };
        const Candidates all{data(scratch_.points), data(scratch_.low), data(scratch_.high),
                             static_cast<std::int32_t>(chunks - 1)};
        std::size_t count = 0;
        for (Index k = first; k < last; ++k) {
            if (count + room > scratch_.entries.size()) {
                scratch_.entries.resize(2 * (count + room));
            }
            const std::size_t near = wanted(k) ? find_near(k, all) : 0;
            const std::size_t made = write_steps(scratch_.numbers.data(), near, chunks, lanes_,
                                                 &scratch_.entries[count]);
            scratch_.lists[at(k - first)] = {scratch_.numbers[0],
                                             static_cast<std::uint16_t>(made / at(lanes_))};
            count += made;
        }
        return count;
    }

    // Finds the candidates within the radius of a point that have another owner; returns their
    // count.
    std::size_t find_near(Index k, const Candidates& all)
    {
        std::uint16_t* const number = scratch_.numbers.data();
        const std::size_t count = loops_.filter(
            all, {destination_.x[at(k)], destination_.y[at(k)], destination_.z[at(k)]}, radius_,
            scratch_.near.data(), number);
        if (choice_.owner.empty()) {
            return count;
        }
        const std::uint16_t* const end = std::remove_if(
            number, number + count, [&](std::uint16_t other) { return same_owner(k, other); });
        return static_cast<std::size_t>(end - number);
    }

    bool same_owner(Index k, std::uint16_t number) const
    {
        const auto owner = [&](Index slot) {
            return choice_.owner[at(slot - choice_.first_owner)];
        };
        const Index slot = scratch_.chunks[number / chunk_slots].slot + number % chunk_slots;
        return owner(slot) == owner(destination_.first_slot + k);
    }

    template <class T>
    const T* stored(const std::vector<T>& values, std::size_t count)
    {
        std::byte* const memory = store_.take(count * sizeof(T));
        std::memcpy(memory, values.data(), count * sizeof(T));
        return reinterpret_cast<const T*>(memory);
    }

    void keep(Index first, Index last, std::size_t entries)
    {
        ListBlock block;
        block.first = static_cast<std::int32_t>(destination_.first_slot + first);
        block.last = static_cast<std::int32_t>(destination_.first_slot + last);
        block.chunks = static_cast<std::int32_t>(scratch_.chunks.size());
        block.chunk = stored(scratch_.chunks, scratch_.chunks.size());
        block.entry = stored(scratch_.entries, entries);
        block.list = stored(scratch_.lists, at(last - first));
        store_.append(block, out_);
    }

    const Tiles& destination_;
    std::span<const ListSource> sources_;
    const ListLoops& loops_;
    int lanes_;
    const ListChoice& choice_;
    ListScratch& scratch_;
    PageStore& store_;
    std::vector<ListBlock>& out_;
    Index tile_ = 0;
    float radius_ = 0;
};

} // namespace

void PairList::build(const Tiles& destination, std::span<const ListSource> sources,
                     const Settings& settings, const ListChoice& choice)
{
    expects(settings.radius <= destination.lattice.edge.minCoeff());
    lanes_ = settings.lanes;
    store_->reset();
    blocks_.clear();
    scratches_.resize(std::max(scratches_.size(), static_cast<std::size_t>(thread_count())));
    parallel_blocks(0, destination.tiles(), [&](Index tile) {
        TileLister(destination, sources, settings, choice, scratches_[at(worker())], *store_,
                   blocks_)
            .list(tile);
    });
    store_->trim();
    std::sort(blocks_.begin(), blocks_.end(),
              [](const ListBlock& a, const ListBlock& b) { return a.first < b.first; });
}

void PairList::clear()
{
    blocks_.clear();
    store_->reset();
}

void PairList::mark_met(std::vector<std::uint8_t>& marks) const
{
    // Several threads may mark the same slot at once; all of them write the same value.
    parallel_blocks(0, static_cast<Index>(blocks_.size()), [&](Index block) {
        for_each_pair_of(blocks_[at(block)], [&](Index, Index j) {
            std::atomic_ref(marks[at(j)]).store(1, std::memory_order_relaxed);
        });
    });
}

void PairList::mark_looked_at(std::vector<std::uint8_t>& marks, Index first) const
{
    for (const ListBlock& block : blocks_) {
        for (const SourceChunk& chunk : std::span(block.chunk, at(block.chunks))) {
            if (chunk.slot >= first) {
                std::fill_n(marks.begin() + (chunk.slot - first), chunk.count, std::uint8_t(1));
            }
        }
    }
}

Index PairList::split(Index first)
{
    const auto rest = std::ranges::stable_partition(blocks_, [&](const ListBlock& block) {
        return std::ranges::none_of(
            std::span(block.chunk, at(block.chunks)),
            [&](const SourceChunk& chunk) { return chunk.count > 0 && chunk.slot >= first; });
    });
    return std::ssize(blocks_) - std::ssize(rest);
}

std::int32_t PairList::most_chunks() const
{
    std::int32_t most = 0;
    for (const ListBlock& block : blocks_) {
        most = std::max(most, block.chunks);
    }
    return most;
}

Index PairList::entries() const
{
    Index total = 0;
    for (const ListBlock& block : blocks_) {
        for (std::int32_t k = 0; k < block.last - block.first; ++k) {
            total += lanes_ * block.list[k].packs;
        }
    }
    return total;
}

std::size_t ListScratch::bytes() const
{
    const auto held = [](const auto&... column) {
        return (0 + ... + (column.capacity() * sizeof(column[0])));
    };
    std::size_t bytes = held(chunks, near, numbers, entries, lists);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        bytes += held(points[axis], low[axis], high[axis]);
    }
    return bytes;
}

std::size_t PairList::bytes() const
{
    std::size_t bytes = store_->bytes() + blocks_.capacity() * sizeof(ListBlock);
    for (const ListScratch& scratch : scratches_) {
        bytes += scratch.bytes();
    }
    return bytes;
}

} // namespace hyoryu
