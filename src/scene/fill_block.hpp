// SPDX-License-Identifier: MIT
// The particles of one block of fluid: on a lattice where it fits the walls, else in columns that
// stand on them.
#pragma once

#include "free_space.hpp"

#include <vector>

namespace hyoryu {

struct BlockParticles {
    std::vector<Vec3> points; // [m]
    Index all = 0;            // that the lattice of the block would have
    Index in_walls = 0;       // of those
    bool cut = false;         // cells are cut by walls, or stretched to hold the volume
};

/// Fills a block.
///
/// All particles have the mass of a cube of the spacing, so cells of that volume hold the water of
/// the block, and every particle wants half a cell of distance from the surfaces.
/// 1. The layers of the block, or the lattice of whole cells nearest to the spacing along each
/// edge, if its cells have that
///    volume within 2 % and every point is in the middle of a free cell or wholly in a wall.
/// 2. Else the block without what walls cover of it from its faces on, on a lattice whose longest
///    edge makes up for what the others are rounded by: its water is right within half a layer
///    across that edge.
/// 3. Else columns along gravity. A column has the particles of the free volume of its cells,
///    rounded to whole ones, each in the middle of its share from the bottom up: lattices that
///    stand on slopes and steps, sheared, which keeps volumes and least distances. What is nearer
///    to a surface than half a spacing goes there.
BlockParticles fill_block(const Scene& scene, std::size_t block);

} // namespace hyoryu
