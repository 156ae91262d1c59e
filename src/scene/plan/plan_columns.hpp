// SPDX-License-Identifier: MIT
// Vertical extents of particles in columns, for warnings of missing support and of leaks.
#pragma once

#include "hyoryu/core/types.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace hyoryu {

/// The lowest and the highest of some numbers.
struct Span {
    double lowest = infinity, highest = -infinity;

    bool empty() const { return highest < lowest; }
    void add(double number) { add(Span{number, number}); }
    void add(const Span& other)
    {
        lowest = std::min(lowest, other.lowest);
        highest = std::max(highest, other.highest);
    }
};

/// Columns one spacing wide, by their numbers along x and y, with the heights of the lowest and the
/// highest of some points in each [m].
class Columns {
public:
    using Number = std::array<long long, 2>;

    Columns() = default;
    explicit Columns(double spacing) : spacing_(spacing) {}

    void add(const Number& column, const Span& heights) { spans_[column].add(heights); }

    /// A column and those about it.
    static std::array<Number, 9> block_about(const Number& column)
    {
        std::array<Number, 9> block{};
        for (long long k = 0; k < 9; ++k) {
            block[at(k)] = {column[0] + k % 3 - 1, column[1] + k / 3 - 1};
        }
        return block;
    }

    Number number_of(const Vec3& p) const
    {
        return {std::llround(std::floor(p.x() / spacing_)),
                std::llround(std::floor(p.y() / spacing_))};
    }
    Vec3 middle_of(const Number& column) const
    {
        return {(static_cast<double>(column[0]) + 0.5) * spacing_,
                (static_cast<double>(column[1]) + 0.5) * spacing_, 0};
    }
    const std::map<Number, Span>& spans() const { return spans_; }
    /// Whether the lowest point of a column is at most 1.5 spacings above the top of a body at a
    /// height [m]: water in a tank above the body does not reach it.
    bool reaches(const Number& column, double height) const
    {
        constexpr double on_it = 1.5; // [spacings]
        const auto found = spans_.find(column);
        return found != spans_.end() && found->second.lowest <= height + on_it * spacing_;
    }
    /// The span of a column and of those about it. Walls that do not follow the lattice leave
    /// columns out.
    Span about(const Number& column) const
    {
        Span all;
        for (const Number& beside : block_about(column)) {
            const auto found = spans_.find(beside);
            if (found != spans_.end()) {
                all.add(found->second);
            }
        }
        return all;
    }

private:
    double spacing_ = 1;
    std::map<Number, Span> spans_;
};

/// Particles of a wall in a column that follow each other without room for water between them.
struct WallStack {
    static constexpr double gap = 1.6; // between two with room [spacings]: surfaces 0.6 apart

    Columns::Number column{};
    double low = 0, high = 0; // of their middles [m]
    std::int64_t wall = 0;

    friend auto operator<=>(const WallStack&, const WallStack&) = default;
};

/// Columns of stacks.
inline Columns columns_of(double spacing, std::span<const WallStack> stacks)
{
    Columns columns(spacing);
    for (const WallStack& stack : stacks) {
        columns.add(stack.column, {stack.low, stack.high});
    }
    return columns;
}

} // namespace hyoryu
