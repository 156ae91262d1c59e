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

/// The pressure that particles see.
struct PackingPressure {
    std::span<const double> depth; // of the fluid, which are the first points [m]
    Kernel kernel;
    Vec3 down{0, 0, -1};
    double solid = 1; // volume of a particle of solids, as a part of that of the fluid
};

/// sum V_j (d_i + d_j) F r of a row i over its neighbours, V_j as a part of the volume of a
/// particle of the fluid, in a fixed order whatever the machine. A solid has the depth that i sees
/// there, d_i - r . down, r = x_i - x_j. Depths below zero count as zero.
Vec3 pressure_sum(const PackingLists& lists, std::span<const Vec3> points,
                  const PackingPressure& pressure, std::size_t i);

} // namespace hyoryu
