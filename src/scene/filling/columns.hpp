// SPDX-License-Identifier: MIT
// Water in columns along gravity, which stand on walls of any form.
#pragma once

#include "scene/surfaces/cells.hpp"
#include "scene/surfaces/free_space.hpp"

#include "hyoryu/ranks/comm.hpp"

#include <vector>

namespace hyoryu {

struct ColumnParticles {
    std::vector<Vec3> points; // [m]
    double cell = 0;          // volume that each of them stands for [m3], [m2] in two dimensions
};

/// Fills the free part of a block in columns of cells. A column has the particles of the free
/// volume of its cells, rounded to whole ones, each in the middle of its share from the bottom up.
/// The share is the same in all columns: nearly a cube of the spacing, adjusted so that all columns
/// together hold the water of the block; with open sides, whose carpets are made of cubes, exactly
/// a cube. Particles nearer to a surface than half a spacing move to that distance. Of several
/// processes each fills a range of the columns.
ColumnParticles in_columns(const Scene& scene, const FreeSpace& space, const Placed& block,
                           const Cells& cells, Comm* comm);

} // namespace hyoryu
