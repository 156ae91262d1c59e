// SPDX-License-Identifier: MIT
// Particles of walls that overlap.
#pragma once

#include "hyoryu/core/types.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace hyoryu {

/// Keeps points that are at least 0.6 spacings from every earlier one but those of its own group,
/// whose distances are right already. A table of cells that edge wide, each with the first point
/// that came into it, by linear probing. Several crowds may have their members among the same
/// points.
class Crowd {
public:
    /// Points of no group keep the distance from all others.
    static constexpr std::int32_t no_group = -1;
    /// Edge of a cell, and least distance of two points [spacings].
    static constexpr double distance = 0.6;

    Crowd(double spacing, const std::vector<Vec3>& points)
        : points_(points), cell_(distance * spacing)
    {
    }

    /// Whether a point has room; if it has, it must be appended to the points at once.
    bool add(const Vec3& p, std::int32_t group = no_group)
    {
        if (2 * (members_.size() + 1) > table_.size()) {
            grow();
        }
        const Cell c = cell_of(p);
        const std::size_t own = slot_of(c);
        if (table_[own] >= 0 && !is_of(group, table_[own])) {
            return false;
        }
        for (int way = 0; way < 27; ++way) {
            const Cell beside{c[0] + way % 3 - 1, c[1] + way / 3 % 3 - 1, c[2] + way / 9 - 1};
            const std::int32_t near = table_[slot_of(beside)];
            if (near >= 0 && !is_of(group, near) && (place_of(near) - p).norm() < cell_) {
                return false;
            }
        }
        if (table_[own] < 0) {
            table_[own] = static_cast<std::int32_t>(members_.size());
        }
        members_.push_back({static_cast<std::int32_t>(points_.size()), group});
        return true;
    }

private:
    using Cell = std::array<Index, 3>;
    struct Member {
        std::int32_t point = 0;
        std::int32_t group = no_group;
    };

    Cell cell_of(const Vec3& p) const
    {
        Cell c{};
        for (int a = 0; a < 3; ++a) {
            c[at(a)] = static_cast<Index>(std::floor(p[a] / cell_));
        }
        return c;
    }
    // The entry of a cell, or the empty one that it would get.
    std::size_t slot_of(const Cell& c) const
    {
        std::uint64_t hash = 1;
        for (const Index k : c) {
            hash = (hash ^ static_cast<std::uint64_t>(k)) * 0x9E3779B97F4A7C15ULL;
            hash ^= hash >> 32;
        }
        std::size_t slot = hash & (table_.size() - 1);
        while (table_[slot] >= 0 && cell_of(place_of(table_[slot])) != c) {
            slot = (slot + 1) & (table_.size() - 1);
        }
        return slot;
    }
    const Vec3& place_of(std::int32_t member) const
    {
        return points_[at(members_[at(member)].point)];
    }
    bool is_of(std::int32_t group, std::int32_t member) const
    {
        return group != no_group && members_[at(member)].group == group;
    }
    void grow()
    {
        table_.assign(std::max<std::size_t>(1024, 2 * table_.size()), -1);
        for (std::int32_t k = 0; k < std::ssize(members_); ++k) {
            std::int32_t& first = table_[slot_of(cell_of(place_of(k)))];
            first = first < 0 ? k : first;
        }
    }

    const std::vector<Vec3>& points_;
    double cell_;
    std::vector<Member> members_;
    std::vector<std::int32_t> table_; // a power of two; members by cell, -1: none
};

} // namespace hyoryu
