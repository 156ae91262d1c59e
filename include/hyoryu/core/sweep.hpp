// SPDX-License-Identifier: MIT
// The fused pair sweep: the terms of all active effects in one loop over the neighbours.
//
// A term is a small value with a name, the fields it reads and writes, and one call per pair. Its
// formula is written once, for a number N that is one real or a pack of them. The sweep gathers:
// a point has one writer, so the sums do not depend on the number of threads, and a pair force is
// computed on both sides by the same expression from exact differences, so action equals reaction
// bit for bit before summation.
#pragma once

#include "hyoryu/core/gather.hpp"
#include "hyoryu/core/kernel.hpp"
#include "hyoryu/core/neighbours.hpp"

#include <concepts>
#include <cstring>
#include <numeric>
#include <string_view>
#include <utility>

namespace hyoryu {

/// The absent effect: reads nothing, writes nothing, compiles to nothing.
struct Off {
    static constexpr std::string_view name = "off";
    using Reads = Fields<>;
    using Writes = Fields<>;
    template <class N>
    void operator()(const Pair<N>&, const auto&, const auto&, auto&) const
    {
    }
};

/// A term can be called with records of exactly the fields it declares, for one number and for a
/// pack: a declaration cannot lie.
template <class T>
concept PairTerm = std::copyable<T> &&
    requires(const T term, const Pair<double>& ij, const Record<typename T::Reads, double>& i,
             Record<typename T::Writes, double>& sum, const Pair<Pack<float, 16>>& packed,
             const Record<typename T::Reads, Pack<float, 16>>& packed_i,
             Record<typename T::Writes, Pack<float, 16>>& packed_sum)
{
    {
        T::name
        } -> std::convertible_to<std::string_view>;
    term(ij, i, i, sum);
    term(packed, packed_i, packed_i, packed_sum);
};

/// The data that the sweeps of one pair kind read and write, as plain addresses: the inner loops
/// call no function that is shared between instruction sets.
template <class Real, class PairKernel = Kernel>
struct SweepView {
    const ListBlock* blocks = nullptr;
    const void* records = nullptr;     // by slot: RecordRow<List, Real>, List as the loop has it
    ColumnPointers columns;            // by row
    const std::int32_t* row = nullptr; // of the destination slots, from `first_slot`
    Index first_slot = 0;
    Vec3 edge{0, 0, 0}; // of a tile [m]
    PairKernel kernel;
};

namespace detail {

/// Copies the records of all source points of a block to contiguous memory, with positions relative
/// to the centre of its tile. The first slot of a padding chunk is far from all points and
/// otherwise zero.
template <int bytes, class List, class Real>
void copy_chunks(const ListBlock& block, const Vec3& of_tile, const RecordRow<List, Real>* records,
                 RecordRow<List, Real>* local)
{
    using Row = RecordRow<List, Real>;
    constexpr int width = std::gcd(bytes, static_cast<int>(sizeof(Row))); // copied at once [bytes]
    constexpr int lanes = Pack<Real, width>::lanes;
    const real edge[3] = {of_tile.x(), of_tile.y(), of_tile.z()};
    constexpr real far_in_edges = 1e6; // its square is finite, and it is beyond every support
    Row nothing;
    nothing.value[0] = static_cast<Real>(far_in_edges * edge[0]);
    for (std::int32_t c = 0; c < block.chunks; ++c) {
        const SourceChunk chunk = block.chunk[c];
        if (chunk.count == 0) {
            local[c * chunk_slots] = nothing;
            continue;
        }
        Row step;
        for (int axis = 0; axis < 3; ++axis) {
            step.value[axis] = static_cast<Real>(static_cast<real>(chunk.step[axis]) * edge[axis]);
        }
        const Real* from = records[chunk.slot].value;
        Real* to = local[c * chunk_slots].value;
        for (int k = 0; k < chunk_slots * Row::size; k += lanes) {
            const auto moved =
                load_register<width>(from + k) + load_register<width>(step.value + k % Row::size);
            std::memcpy(to + k, &moved, sizeof moved);
        }
    }
}

/// The columns of the listed fields, found once.
template <class Out>
struct OutColumns {
    real* first[Out::count];

    explicit OutColumns(const ColumnPointers& columns)
    {
        int k = 0;
        for_each(Out{}, [&](auto field) { first[k++] = columns[field]; });
    }
};

/// Adds the lanes of every field of `sum` to the row of the columns.
template <class Out>
void accumulate(const OutColumns<Out>& columns, Index row, const auto& sum)
{
    int k = 0;
    for_each(Out{}, [&](auto field) {
        real* const to = columns.first[k++] + width<decltype(field)> * row;
        if constexpr (width<decltype(field)> == 3) {
            to[0] += lane_sum(sum[field].x);
            to[1] += lane_sum(sum[field].y);
            to[2] += lane_sum(sum[field].z);
        } else {
            *to += lane_sum(sum[field]);
        }
    });
}

} // namespace detail

/// columns[Writes]_i += sum over the neighbours j of point i of all terms, for every point of one
/// block. Outputs add up over the pair kinds of a stage; `clear` them first. `local` has room for
/// all chunks of the block.
// Flattened, since passing a record of packs through memory costs more than the pair. Kernel and
// terms are copies, so that the compiler need not reload them after every store.
template <int bytes, class List, class Real, class PairKernel, PairTerm... Terms>
[[gnu::flatten]] void sweep_block(const SweepView<Real, PairKernel>& view, Index block_index,
                                  // NOLINTNEXTLINE(performance-unnecessary-value-param)
                                  RecordRow<List, Real>* local, const Terms... terms)
{
    using Out = Union<typename Terms::Writes...>;
    using N = Pack<Real, bytes>;
    if constexpr (Out::count > 0) {
        const ListBlock block = view.blocks[block_index];
        const PairKernel kernel = view.kernel;
        const detail::OutColumns<Out> out(view.columns);
        const auto* const records = static_cast<const RecordRow<List, Real>*>(view.records);
        detail::copy_chunks<bytes>(block, view.edge, records, local);
        const std::uint8_t* entry = block.entry;
        for (std::int32_t slot = block.first; slot < block.last; ++slot) {
            const ListHead list = block.list[slot - block.first];
            const std::uint8_t* const end = entry + N::lanes * list.packs;
            if (entry == end) {
                continue;
            }
            const RecordRow<List, Real>* at = local + list.start;
            const Real* const own = records[slot].value;
            const auto i =
                detail::assemble<List, N>([&](int k) { return N(static_cast<double>(own[k])); });
            Record<Out, N> sum;
            for (; entry != end; entry += N::lanes) {
                const auto j = detail::gather<bytes>(at, entry);
                const Pair<N> ij = kernel(i[field::position] - j[field::position]);
                (terms(ij, i, j, sum), ...);
            }
            detail::accumulate(out, view.row[slot - view.first_slot], sum);
        }
    }
}

/// A row of a store.
struct StoreRow {
    Store* store;
    Index row;
};

/// Reference implementation of the same sums, one pair at a time in double precision; the fast one
/// is tested against it. `place` is the store and row of a slot.
template <class List, class... Terms>
void sweep_reference(const PairList& pairs, const auto& place, const auto& kernel,
                     const Terms&... terms)
{
    using Out = Union<typename Terms::Writes...>;
    const auto record = [](const StoreRow& from) {
        Record<List, real> values;
        for_each(List{}, [&](auto field) {
            if (!from.store->may_have(field)) {
                return; // a field of the other kind of particles: zero
            }
            const auto& value = std::as_const(*from.store)[field][from.row];
            if constexpr (width<decltype(field)> == 3) {
                values[field] = {value.x(), value.y(), value.z()};
            } else {
                values[field] = value;
            }
        });
        return values;
    };
    pairs.for_each_pair([&](Index slot_i, Index slot_j) {
        const StoreRow to = place(slot_i);
        const auto i = record(to);
        const auto j = record(place(slot_j));
        const Pair<real> ij = kernel(i[field::position] - j[field::position]);
        Record<Out, real> sum;
        (terms(ij, i, j, sum), ...);
        detail::accumulate(detail::OutColumns<Out>(to.store->pointers()), to.row, sum);
    });
}

/// Sets the listed columns of a store to zero, those that it has.
template <class List>
void clear(Store& store, List fields)
{
    for_each(fields, [&](auto field) {
        if (!store.has(field)) {
            return;
        }
        const auto column = store[field];
        const auto zero = uniform<typename decltype(field)::type>(0);
        parallel_for(0, store.size(), [&](Index k) { column[k] = zero; });
    });
}

} // namespace hyoryu
