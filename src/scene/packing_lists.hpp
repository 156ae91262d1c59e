// SPDX-License-Identifier: MIT
// Neighbours of the particles whose packing is relaxed, and the pressure that they exert.
#pragma once

#include "hyoryu/core/kernel.hpp"

#include <span>
#include <vector>

namespace hyoryu {

/// Lists of the first rows of some points, block by block, filled up to whole packs with the row
/// itself, which adds nothing to a sum of differences.
struct PackingLists {
    struct Head {
        std::size_t first = 0, last = 0; // range of the entries of a row
    };
    struct Block {
        std::vector<std::int32_t> entries;
        std::vector<Head> heads;
    };
    std::vector<Block> blocks;
};

/// The points within `reach` [m] of each of the first `moving` ones, the row itself included.
void make_lists(std::span<const Vec3> points, Index moving, double reach, PackingLists& lists);

/// sum (d_i + d_j) F r of a row i over its neighbours, in a fixed order whatever the machine.
/// `depth`: of the fluid, which are the first points [m]; a solid has the one that i sees there,
/// d_i - r . down, r = x_i - x_j. Depths below zero count as zero.
Vec3 pressure_sum(const PackingLists& lists, std::span<const Vec3> points,
                  std::span<const double> depth, const Kernel& kernel, const Vec3& down,
                  std::size_t i);

} // namespace hyoryu
