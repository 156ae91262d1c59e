// SPDX-License-Identifier: MIT
// The particles of one block of fluid: on a lattice where it fits the walls, else in columns that
// stand on them.
#pragma once

#include "fill_region.hpp"
#include "scene/surfaces/free_space.hpp"

#include <vector>

namespace hyoryu {

struct BlockParticles {
    std::vector<Vec3> points; // [m]
    Index all = 0;            // that the lattice of the block would have
    Index in_walls = 0;       // of those
    double cell = 0;          // volume that each point stands for [m3], [m2] in two dimensions
    bool cut = false;         // cells are cut by walls, or stretched to hold the volume
};

/// Fills a block. Of several processes, which call it together, each gets the points of a range of
/// the cells, one process after the other in the order in which one process has them; `all` and
/// `in_walls` are of all.
///
/// Cells are as large as cubes of the spacing, or nearly so, and every particle wants half a cell
/// of distance from the surfaces. The water of the block is right: its cells fill it.
/// 1. The layers of the block, or the lattice of whole cells nearest to the spacing along each
///    edge, if its cells have the volume of a cube within 2 % and every point is in the middle of a
///    free cell or wholly in a wall.
/// 2. Else the block without what walls cover of it from its faces on, on a lattice whose longest
///    edge makes up for what the others are rounded by.
/// 3. Else columns along gravity: lattices that stand on slopes and steps, sheared, which keeps
///    volumes and least distances.
BlockParticles fill_block(const Scene& scene, std::size_t block, Comm* comm);

} // namespace hyoryu
