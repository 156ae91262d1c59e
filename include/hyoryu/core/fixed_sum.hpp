// SPDX-License-Identifier: MIT
// Sums whose bits do not depend on the order of their terms, nor on how the work is shared. Numbers
// become multiples of a unit, integers of 128 bits, and integers add exactly. Many terms are first
// added by tile as plain numbers, in the order of the slots, which costs as little as a plain sum.
#pragma once

#include "hyoryu/core/tiles.hpp"

#include <array>
#include <cmath>
#include <span>

namespace hyoryu {

/// The unit of a sum in fixed point: a power of two, in the unit of the numbers.
struct FixedUnit {
    double size = 1;
    double inverse = 1;
};

/// The unit of numbers whose usual size is `reference`, of which only the binary exponent counts:
/// 2^-70 or 8e-22 of it. A reference that is not a positive finite number counts as one.
inline FixedUnit fixed_unit(double reference)
{
    constexpr int digits_below = 70;
    constexpr int farthest = 900; // unit, inverse and limit of a term stay normal numbers
    const bool usable = std::isfinite(reference) && reference > 0;
    const int exponent = usable ? std::clamp(std::ilogb(reference), -farthest, farthest) : 0;
    return {std::ldexp(1.0, exponent - digits_below), std::ldexp(1.0, digits_below - exponent)};
}

/// A sum in fixed point. A term loses what is below the unit. A term that is not finite or not
/// below 2^95 units, 3e7 references, makes the sum not-a-number, in whatever order it comes: 2^31
/// smaller terms stay below 2^126 units, so that no partial sum overflows.
class FixedSum {
public:
    void add(double term, const FixedUnit& unit)
    {
        constexpr double limit = 0x1p95;
        const double units = term * unit.inverse;
        const bool fits = std::abs(units) < limit; // false for not-a-number
        units_ += fits ? static_cast<Integer>(units) : 0;
        fits_ = fits_ && fits;
    }
    void add(const FixedSum& other)
    {
        units_ += other.units_;
        fits_ = fits_ && other.fits_;
    }
    /// The sum, rounded once.
    double value(const FixedUnit& unit) const
    {
        return fits_ ? static_cast<double>(units_) * unit.size
                     : std::numeric_limits<double>::quiet_NaN();
    }

private:
    __extension__ typedef __int128 Integer;
    Integer units_ = 0;
    bool fits_ = true;
};

template <std::size_t n>
using FixedUnits = std::array<FixedUnit, n>;

/// Sums of n numbers, such as the components of a vector.
template <std::size_t n>
class FixedSums {
public:
    void add(const std::array<double, n>& terms, const FixedUnits<n>& units)
    {
        for (std::size_t k = 0; k < n; ++k) {
            sums_[k].add(terms[k], units[k]);
        }
    }
    void add(const FixedSums& other)
    {
        for (std::size_t k = 0; k < n; ++k) {
            sums_[k].add(other.sums_[k]);
        }
    }
    std::array<double, n> values(const FixedUnits<n>& units) const
    {
        std::array<double, n> values;
        for (std::size_t k = 0; k < n; ++k) {
            values[k] = sums_[k].value(units[k]);
        }
        return values;
    }
    /// The sum of each number.
    std::span<FixedSum> each() { return sums_; }

private:
    std::array<FixedSum, n> sums_;
};

/// Sums over blocks of work: add(block, sums) adds the terms of one block to sums of its thread.
template <std::size_t n, class F>
FixedSums<n> sum_of_blocks(Index blocks, const F& add)
{
    constexpr Index most_parts = 64;
    constexpr Index part_blocks = 32; // fewer are not worth another thread
    std::array<FixedSums<n>, most_parts> partial{};
    const Index parts = std::clamp<Index>(blocks / part_blocks, 1, most_parts);
    parallel_blocks(
        0, parts,
        [&](Index part) {
            for (Index k = part * blocks / parts; k < (part + 1) * blocks / parts; ++k) {
                add(k, partial[part]);
            }
        },
        2);
    FixedSums<n> all;
    for (Index part = 0; part < parts; ++part) {
        all.add(partial[part]);
    }
    return all;
}

/// Sums of term(row) over the points of all tiles: plain numbers within a tile, in the order of its
/// slots, then tiles in fixed point.
template <std::size_t n, class F>
FixedSums<n> sums_by_tile(const Tiles& tiles, const FixedUnits<n>& units, const F& term)
{
    const auto add_tile = [&](Index tile, FixedSums<n>& sums) {
        const auto t = static_cast<std::size_t>(tile);
        std::array<double, n> of_tile{};
        for (auto slot = tiles.start[t]; slot < tiles.start[t + 1]; ++slot) {
            const std::array<double, n> own = term(tiles.row[slot]);
            for (std::size_t k = 0; k < n; ++k) {
                of_tile[k] += own[k];
            }
        }
        sums.add(of_tile, units);
    };
    return sum_of_blocks<n>(tiles.tiles(), add_tile);
}

/// Sums of term(k) for k in [0, count), each number in fixed point: for terms of which there are
/// few, or that stand in no order.
template <std::size_t n, class F>
FixedSums<n> sums_of_each(Index count, const FixedUnits<n>& units, const F& term)
{
    constexpr Index block_terms = 64;
    const auto add_block = [&](Index block, FixedSums<n>& sums) {
        for (Index k = block * block_terms; k < std::min(count, (block + 1) * block_terms); ++k) {
            sums.add(term(k), units);
        }
    };
    return sum_of_blocks<n>((count + block_terms - 1) / block_terms, add_block);
}

} // namespace hyoryu
