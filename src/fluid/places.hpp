// SPDX-License-Identifier: MIT
// Whether points are near to others.
#pragma once

#include "hyoryu/core/types.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace hyoryu {

/// Places in cells; only looked up, never walked. `distance`: within which a place is taken [m].
class Places {
public:
    explicit Places(real distance) : distance_(distance) {}

    void add(const Vec3& x) { cells_.emplace(key(cell(x)), x); }
    /// Whether no place is nearer than the distance.
    bool is_free(const Vec3& x) const
    {
        const auto c = cell(x);
        for (Index way = 0; way < 27; ++way) {
            const auto [from, to] = cells_.equal_range(
                key({c[0] + way % 3 - 1, c[1] + way / 3 % 3 - 1, c[2] + way / 9 - 1}));
            for (auto near = from; near != to; ++near) {
                if ((near->second - x).norm() < distance_) {
                    return false;
                }
            }
        }
        return true;
    }

private:
    std::array<Index, 3> cell(const Vec3& x) const
    {
        std::array<Index, 3> c{};
        for (int a = 0; a < 3; ++a) {
            c[a] = static_cast<Index>(std::floor(x[a] / distance_));
        }
        return c;
    }
    static std::uint64_t key(const std::array<Index, 3>& c)
    {
        std::uint64_t h = 1;
        for (const Index v : c) {
            h = (h ^ static_cast<std::uint64_t>(v)) * 0x9E3779B97F4A7C15ULL;
        }
        return h;
    }
    real distance_;
    std::unordered_multimap<std::uint64_t, Vec3> cells_;
};

} // namespace hyoryu
