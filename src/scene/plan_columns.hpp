// SPDX-License-Identifier: MIT
// Particles in vertical columns, for warnings of what lies above what.
#pragma once

#include "hyoryu/core/types.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace hyoryu {

/// Columns one spacing wide, by their numbers along x and y, with the lowest and the highest of
/// some points in each.
class Columns {
public:
    using Number = std::array<long long, 2>;
    struct Span {
        double lowest = infinity, highest = -infinity; // [m]
    };

    Columns(double spacing, const std::vector<Vec3>& points) : spacing_(spacing)
    {
        for (const Vec3& p : points) {
            Span& span = spans_[number_of(p)];
            span.lowest = std::min(span.lowest, p.z());
            span.highest = std::max(span.highest, p.z());
        }
    }

    /// A column and those about it.
    static std::array<Number, 9> block_about(const Number& column)
    {
        std::array<Number, 9> block{};
        for (long long k = 0; k < 9; ++k) {
            block[static_cast<std::size_t>(k)] = {column[0] + k % 3 - 1, column[1] + k / 3 - 1};
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
    /// Whether the points of a column begin no higher than the particles that lie on a body with
    /// its top at a height [m]: water in a tank over it does not reach it.
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
                all.lowest = std::min(all.lowest, found->second.lowest);
                all.highest = std::max(all.highest, found->second.highest);
            }
        }
        return all;
    }

private:
    double spacing_;
    std::map<Number, Span> spans_;
};

} // namespace hyoryu
