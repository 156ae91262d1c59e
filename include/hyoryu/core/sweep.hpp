// SPDX-License-Identifier: MIT
// The fused pair sweep: the terms of all active effects in one loop over the neighbours.
//
// A term is a small value with a name, the fields it reads and writes, and one call per pair. Its
// formula is written once, for a number N that is one real or a pack of them. The sweep gathers:
// row i has one writer, so the sums do not depend on the number of threads, and a pair force is
// computed on both sides by the same expression, so action equals reaction bit for bit before
// summation.
#pragma once

#include "hyoryu/core/kernel.hpp"
#include "hyoryu/core/neighbours.hpp"
#include "hyoryu/core/particles.hpp"

#include <concepts>
#include <cstring>
#include <string_view>

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

/// A term can be called with records of exactly the fields it declares: a declaration cannot lie.
template <class T>
concept PairTerm = std::copyable<T> &&
    requires(const T term, const Pair<Pack>& ij, const Record<typename T::Reads, Pack>& i,
             Record<typename T::Writes, Pack>& sum)
{
    {
        T::name
        } -> std::convertible_to<std::string_view>;
    term(ij, i, i, sum);
};

/// One row of a record store: whole packs, so that a neighbour is a few aligned loads.
struct alignas(lanes * sizeof(real)) Quad {
    real value[lanes];
};

/// The fields of List of all rows side by side, plus the void row at the end: far from everything
/// and otherwise zero.
template <class List>
class Records {
public:
    static_assert(contains<Position, List>, "a pair needs positions");
    static constexpr int quads = (List::scalars + lanes - 1) / lanes;

    /// Copies columns of all rows; by default all of the list, else only the named ones.
    template <class Some = List>
    void load(const Particles& particles, Some fields = {})
    {
        const Rows rows{0, particles.size()};
        resize(particles.size());
        for_each(fields, [&](auto field) {
            const auto column = particles[field];
            parallel_for(rows.begin, rows.end, [&](Index k) {
                real* row = at(k);
                const auto& value = column[static_cast<std::size_t>(k)];
                if constexpr (width<decltype(field)> == 3) {
                    row[offset<decltype(field), List>] = value.x();
                    row[offset<decltype(field), List> + 1] = value.y();
                    row[offset<decltype(field), List> + 2] = value.z();
                } else {
                    row[offset<decltype(field), List>] = value;
                }
            });
        });
    }

    /// One row in every lane, or as a scalar.
    template <class N>
    Record<List, N> same(Index row) const
    {
        const real* values = at(row);
        return assemble<N>([&](int k) { return broadcast<N>(values[k]); });
    }
    /// One row in each lane.
    Record<List, Pack> gather(const std::int32_t* rows) const
    {
        Pack flat[quads * lanes];
        for (int q = 0; q < quads; ++q) {
            transpose(load_pack(rows[0], q), load_pack(rows[1], q), load_pack(rows[2], q),
                      load_pack(rows[3], q), flat + q * lanes);
        }
        return assemble<Pack>([&](int k) { return flat[k]; });
    }

private:
    static constexpr real far = 1e30; // [m]; its square is finite and beyond every support

    real* at(Index row) { return quads_[static_cast<std::size_t>(row * quads)].value; }
    const real* at(Index row) const { return quads_[static_cast<std::size_t>(row * quads)].value; }

    void resize(Index rows)
    {
        quads_.resize(static_cast<std::size_t>((rows + 1) * quads));
        real* row = at(rows);
        std::fill(row, row + quads * lanes, real(0));
        row[offset<Position, List>] = far;
    }
    Pack load_pack(std::int32_t row, int q) const
    {
        Pack pack;
        std::memcpy(&pack,
                    &quads_[static_cast<std::size_t>(row) * quads + static_cast<std::size_t>(q)],
                    sizeof pack);
        return pack;
    }
    // Four rows to four columns.
    static void transpose(const Pack& a, const Pack& b, const Pack& c, const Pack& d, Pack* out)
    {
        const Pack ab02 = __builtin_shufflevector(a, b, 0, 4, 2, 6);
        const Pack ab13 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
        const Pack cd02 = __builtin_shufflevector(c, d, 0, 4, 2, 6);
        const Pack cd13 = __builtin_shufflevector(c, d, 1, 5, 3, 7);
        out[0] = __builtin_shufflevector(ab02, cd02, 0, 1, 4, 5);
        out[1] = __builtin_shufflevector(ab13, cd13, 0, 1, 4, 5);
        out[2] = __builtin_shufflevector(ab02, cd02, 2, 3, 6, 7);
        out[3] = __builtin_shufflevector(ab13, cd13, 2, 3, 6, 7);
    }
    template <class N, class Get>
    static Record<List, N> assemble(const Get& get)
    {
        Record<List, N> record;
        for_each(List{}, [&](auto field) {
            constexpr int at = offset<decltype(field), List>;
            if constexpr (width<decltype(field)> == 3) {
                record[field] = {get(at), get(at + 1), get(at + 2)};
            } else {
                record[field] = get(at);
            }
        });
        return record;
    }

    std::vector<Quad> quads_;
};

namespace detail {

/// Adds the lanes of every field of `sum` to row i of the columns.
template <class Out>
void accumulate(Particles& particles, Index i, const auto& sum)
{
    for_each(Out{}, [&](auto field) {
        particles[field][static_cast<std::size_t>(i)] += lane_sum(sum[field]);
    });
}

} // namespace detail

/// particles[Writes]_i += sum over the neighbours j of row i of all terms, for every row of the
/// list. Outputs add up over the pair kinds of a stage; `clear` them first.
template <class In, class K, PairTerm... Terms>
void sweep(Particles& particles, const PairList& pairs, const Records<In>& records, const K& kernel,
           const Terms&... terms)
{
    using Out = Union<typename Terms::Writes...>;
    if constexpr (Out::count > 0) {
        const Rows rows = pairs.rows();
        const Index blocks = (rows.size() + PairList::block_rows - 1) / PairList::block_rows;
        parallel_blocks(0, blocks, [&](Index block) {
            const Index first = rows.begin + block * PairList::block_rows;
            const Index last = std::min(rows.end, first + PairList::block_rows);
            for (Index i = first; i < last; ++i) {
                const auto neighbours = pairs[i];
                if (neighbours.empty()) {
                    continue;
                }
                const auto a = records.template same<Pack>(i);
                Record<Out, Pack> sum;
                for (std::size_t k = 0; k < neighbours.size(); k += lanes) {
                    const auto b = records.gather(&neighbours[k]);
                    const Pair<Pack> ij = kernel(a[field::position] - b[field::position]);
                    (terms(ij, a, b, sum), ...);
                }
                detail::accumulate<Out>(particles, i, sum);
            }
        });
    }
}

/// The same sums, one pair at a time: the clear version that the fast one is tested against.
template <class In, class K, class... Terms>
void sweep_reference(Particles& particles, const PairList& pairs, const Records<In>& records,
                     const K& kernel, const Terms&... terms)
{
    using Out = Union<typename Terms::Writes...>;
    const Rows rows = pairs.rows();
    for (Index i = rows.begin; i < rows.end; ++i) {
        const auto a = records.template same<real>(i);
        Record<Out, real> sum;
        for (const std::int32_t j : pairs[i]) {
            const auto b = records.template same<real>(j);
            const Pair<real> ij = kernel(a[field::position] - b[field::position]);
            (terms(ij, a, b, sum), ...);
        }
        detail::accumulate<Out>(particles, i, sum);
    }
}

/// Sets the listed columns of the rows to zero.
template <class List>
void clear(Particles& particles, Rows rows, List fields)
{
    for_each(fields, [&](auto field) {
        const auto column = particles[field];
        typename decltype(field)::type nothing{};
        if constexpr (width<decltype(field)> == 3) {
            nothing.setZero();
        }
        parallel_for(rows.begin, rows.end,
                     [&](Index k) { column[static_cast<std::size_t>(k)] = nothing; });
    });
}

} // namespace hyoryu
