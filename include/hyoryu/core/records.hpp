// SPDX-License-Identifier: MIT
// What the pair loops read: the fields of a point side by side, in the number of the loops.
#pragma once

#include "hyoryu/core/parallel.hpp"
#include "hyoryu/core/tiles.hpp"

#include <span>

namespace hyoryu {

namespace detail {
// So that no record crosses a line of the cache that need not.
constexpr std::size_t row_alignment(std::size_t bytes)
{
    return bytes % 64 == 0 ? 64 : bytes % 32 == 0 ? 32 : 16;
}
} // namespace detail

/// The fields of List of one point, whole registers of 16 bytes; 32 bytes for eight floats. The
/// position comes first, relative to the centre of the point's tile.
template <class List, class Real>
struct alignas(detail::row_alignment((List::scalars * sizeof(Real) + 15) / 16 * 16)) RecordRow {
    static_assert(offset<Position, List> == 0, "a pair needs positions, and they come first");
    /// Numbers in 16 bytes, and how often those are needed.
    static constexpr int quad = 16 / static_cast<int>(sizeof(Real));
    static constexpr int quads = (List::scalars + quad - 1) / quad;
    static constexpr int size = quads * quad;
    Real value[size]{};
};

/// Records of all slots.
template <class List, class Real>
class Records {
public:
    using Row = RecordRow<List, Real>;

    /// Room for so many slots, and for a chunk that begins at the last one.
    void resize(Index slots) { rows_.resize(static_cast<std::size_t>(slots + chunk_slots)); }

    /// Copies columns to the records of the points; by default all of the list, else only the named
    /// ones. Positions are rounded to the unit of the lattice, half a millionth of a spacing in
    /// single precision.
    template <class Some = List>
    void load(const Store& store, const Tiles& tiles, Some fields = {})
    {
        parallel_blocks(0, tiles.tiles(),
                        [&](Index tile) { load_tile(store, tiles, tile, fields); });
    }
    /// The same for some of the tiles.
    template <class Some>
    void load(const Store& store, const Tiles& tiles, std::span<const std::int32_t> which,
              Some fields)
    {
        parallel_blocks(0, static_cast<Index>(which.size()), [&](Index k) {
            load_tile(store, tiles, which[static_cast<std::size_t>(k)], fields);
        });
    }

    /// Puts value_of(row) to the place that records have for a field, on loan until that is loaded
    /// again: a record holds no more than most loops read.
    template <Field To>
    void lend(const Tiles& tiles, To, const auto& value_of)
    {
        constexpr int to = offset<To, List>;
        parallel_for(0, tiles.count(), [&](Index k) {
            const auto row = static_cast<std::size_t>(tiles.row[static_cast<std::size_t>(k)]);
            Real* const value = &at(tiles.first_slot + k).value[to];
            if constexpr (width<To> == 3) {
                put(value, value_of(row));
            } else {
                *value = static_cast<Real>(value_of(row));
            }
        });
    }
    /// The same with the values of another column.
    template <Field From, Field To>
    void lend(const Store& store, const Tiles& tiles, From from, To to)
    {
        static_assert(width<From> == width<To>);
        const auto column = store[from];
        lend(tiles, to, [&](std::size_t row) { return column[row]; });
    }

    const Row* data() const { return rows_.data(); }
    /// Their memory, for who needs some between two uses of the records.
    std::span<std::byte> room() { return std::as_writable_bytes(std::span(rows_)); }
    /// Bytes held.
    std::size_t bytes() const { return rows_.capacity() * sizeof(Row); }

private:
    Row& at(Index slot) { return rows_[static_cast<std::size_t>(slot)]; }

    template <class Some>
    void load_tile(const Store& store, const Tiles& tiles, Index tile_index, Some fields)
    {
        const auto tile = static_cast<std::size_t>(tile_index);
        // Adding a large number in double, as `rounded` does, leaves no more than 50 digits.
        const real unit = tiles.lattice.unit(std::min(std::numeric_limits<Real>::digits, 50));
        const Vec3 centre = tiles.lattice.centre(tiles.tile[tile]);
        for_each(fields, [&](auto field) {
            const auto column = store[field];
            constexpr int to = offset<decltype(field), List>;
            for (Index k = tiles.start[tile]; k < tiles.start[tile + 1]; ++k) {
                const auto row = static_cast<std::size_t>(tiles.row[static_cast<std::size_t>(k)]);
                Real* const value = &at(tiles.first_slot + k).value[to];
                if constexpr (std::is_same_v<decltype(field), Position>) {
                    put(value, rounded(column[row] - centre, unit));
                } else if constexpr (width<decltype(field)> == 3) {
                    put(value, column[row]);
                } else {
                    *value = static_cast<Real>(column[row]);
                }
            }
        });
    }

    static void put(Real* to, const Vec3& value)
    {
        to[0] = static_cast<Real>(value.x());
        to[1] = static_cast<Real>(value.y());
        to[2] = static_cast<Real>(value.z());
    }
    // To the nearest multiple: a number so large that its last digit is the unit drops all below.
    static Vec3 rounded(const Vec3& r, real unit)
    {
        const real large = 0x1.8p52 * unit;
        return ((r.array() + large) - large).matrix();
    }

    std::vector<Row> rows_;
};

} // namespace hyoryu
