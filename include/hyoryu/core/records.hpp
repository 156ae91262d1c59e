// SPDX-License-Identifier: MIT
// The input of the pair loops: one record per point with its fields in the precision of the loops.
// A loop whose terms read only fields of the common list uses the common records; any other loop
// uses records of its own list, which are copied from the columns.
#pragma once

#include "hyoryu/core/parallel.hpp"
#include "hyoryu/core/tiles.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

namespace hyoryu {

namespace detail {
// Keeps records from crossing a cache line unnecessarily.
constexpr std::size_t row_alignment(std::size_t bytes)
{
    return bytes % 64 == 0 ? 64 : bytes % 32 == 0 ? 32 : 16;
}
} // namespace detail

/// The fields of List of one point, padded to whole registers of 16 bytes. The position comes
/// first, relative to the centre of the point's tile.
template <class List, class Real>
struct alignas(detail::row_alignment((List::scalars * sizeof(Real) + 15) / 16 * 16)) RecordRow {
    static_assert(offset<Position, List> == 0, "a pair needs positions, and they come first");
    /// Numbers per quad (16 bytes), and quads per record.
    static constexpr int quad = 16 / static_cast<int>(sizeof(Real));
    static constexpr int quads = (List::scalars + quad - 1) / quad;
    static constexpr int size = quads * quad;
    Real value[size]{};
};

/// The fields of the records for a loop over some terms: the common list if it contains all fields
/// that they read, else the position and the union of these fields.
template <class Common, class... Terms>
using RecordList =
    std::conditional_t<std::is_same_v<Union<Common, typename Terms::Reads...>, Common>, Common,
                       Union<Fields<Position>, typename Terms::Reads...>>;

/// Memory for records of any list, aligned to cache lines.
class RecordMemory {
public:
    /// Memory of at least `bytes` bytes, aligned to 64; its contents are lost when it grows.
    std::byte* at_least(std::size_t bytes)
    {
        const std::size_t lines = (bytes + sizeof(Line) - 1) / sizeof(Line);
        if (lines > lines_.size()) {
            lines_ = std::vector<Line>(); // freed first: the two need not exist side by side
            lines_.resize(lines);
        }
        return data();
    }
    std::byte* data() { return reinterpret_cast<std::byte*>(lines_.data()); }
    /// The memory as scratch space while no records are in use.
    std::span<std::byte> room() { return std::as_writable_bytes(std::span(lines_)); }
    /// Bytes held.
    std::size_t bytes() const { return lines_.capacity() * sizeof(Line); }

private:
    struct alignas(64) Line {
        std::byte byte[64];
    };
    std::vector<Line> lines_;
};

/// The records of all slots, in memory that another object owns.
template <class List, class Real>
class Records {
public:
    using Row = RecordRow<List, Real>;
    /// The tiles that a call is for, by their indices; none: all.
    using Which = std::optional<std::span<const std::int32_t>>;

    /// Records of `slots` slots and one more chunk, as a chunk may begin at the last slot.
    Records(RecordMemory& memory, Index slots)
        : rows_(reinterpret_cast<Row*>(
              memory.at_least(static_cast<std::size_t>(slots + chunk_slots) * sizeof(Row))))
    {
    }

    /// Copies columns to the records of the points; by default all of the list, else only the named
    /// ones. Positions are rounded to the unit of the lattice, half a millionth of a spacing in
    /// single precision.
    template <class Some = List>
    void load(const Store& store, const Tiles& tiles, Some fields = {}, Which which = {})
    {
        over(tiles, which, [&](Index tile) { load_tile(store, tiles, tile, fields); });
    }

    /// Fills records with more fields than the common ones: the common fields are copied from the
    /// common records, the others from the columns.
    template <class Common>
    void complete(Records<Common, Real> common, const Store& store, const Tiles& tiles,
                  Which which = {})
    {
        over(tiles, which, [&](Index tile) { complete_tile(common, store, tiles, tile); });
    }

    /// Sets a field of the records to value_of(row), where neighbours have to see another value
    /// than that of the column.
    template <Field To>
    void show(const Tiles& tiles, To, const auto& value_of)
    {
        constexpr int to = offset<To, List>;
        parallel_for(0, tiles.count(), [&](Index k) {
            const auto row = static_cast<std::size_t>(tiles.row[k]);
            Real* const value = &at(tiles.first_slot + k).value[to];
            if constexpr (width<To> == 3) {
                put(value, value_of(row));
            } else {
                *value = static_cast<Real>(value_of(row));
            }
        });
    }

    Row* data() { return rows_; }

private:
    Row& at(Index slot) { return rows_[slot]; }

    static void over(const Tiles& tiles, const Which& which, const auto& f)
    {
        const Index count = which ? std::ssize(*which) : tiles.tiles();
        parallel_blocks(0, count, [&](Index k) { f(which ? Index{(*which)[k]} : k); });
    }

    template <class Common>
    void complete_tile(Records<Common, Real> common, const Store& store, const Tiles& tiles,
                       Index tile_index)
    {
        for_each(List{}, [&](auto field) {
            using Of = decltype(field);
            if constexpr (!contains<Of, Common>) {
                load_tile(store, tiles, tile_index, Fields<Of>{});
                return;
            } else {
                const auto tile = static_cast<std::size_t>(tile_index);
                for (Index k = tiles.start[tile]; k < tiles.start[tile + 1]; ++k) {
                    const Index slot = tiles.first_slot + k;
                    for (int axis = 0; axis < width<Of>; ++axis) {
                        at(slot).value[offset<Of, List> + axis] =
                            common.data()[slot].value[offset<Of, Common> + axis];
                    }
                }
            }
        });
    }

    template <class Some>
    void load_tile(const Store& store, const Tiles& tiles, Index tile_index, Some fields)
    {
        const auto tile = static_cast<std::size_t>(tile_index);
        // Adding a large number in double, as `rounded` does, leaves no more than 50 digits.
        const real unit = tiles.lattice.unit(std::min(std::numeric_limits<Real>::digits, 50));
        const Vec3 centre = tiles.lattice.centre(tiles.tile[tile]);
        for_each(fields, [&](auto field) {
            constexpr int to = offset<decltype(field), List>;
            if (!store.may_have(field)) { // a field of the other kind of particles only
                for (Index k = tiles.start[tile]; k < tiles.start[tile + 1]; ++k) {
                    std::fill_n(&at(tiles.first_slot + k).value[to], width<decltype(field)>,
                                Real(0));
                }
                return;
            }
            const auto column = store[field];
            for (Index k = tiles.start[tile]; k < tiles.start[tile + 1]; ++k) {
                const auto row = static_cast<std::size_t>(tiles.row[k]);
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

    Row* rows_;
};

} // namespace hyoryu
