// SPDX-License-Identifier: MIT
// Still water that fills the space connected with a seed: a flood fill over cells.
#pragma once

#include "free_space.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace hyoryu {

/// Cells of the edge of the spacing in a box below the level, and which of them are reached.
struct SeededCells {
    Vec3 first{0, 0, 0}; // lower corner of the lattice [m]; its top is the level
    double edge = 0;     // [m]
    std::array<Index, 3> count{0, 0, 0};
    std::vector<std::uint8_t> wet; // x fastest, then y
    Index reached = 0;             // cells that are wet
    std::optional<Vec3> leak;      // a cell at the rim that is open outwards, beside windows [m]
    std::string fault;             // why none is wet; empty if some are
};

/// The cells that a flood from the seed of a block reaches: from cell to cell across faces, along
/// lines from middle to middle that are free of walls and of other blocks. `within`: x, y and the
/// lowest z of the box; a box about the wet cells gives the same ones again.
SeededCells seeded_cells(const Scene& scene, std::size_t block, const Bounds& within);

/// The box about the wet cells and those beside them, within the lattice [m].
Bounds box_about(const SeededCells& cells);

/// Whether the middle of a wet cell of one lies in a wet cell of the other.
bool share_a_cell(const SeededCells& a, const SeededCells& b);

/// Whether a place is in a wet cell, or in one beside it and not behind a wall.
bool is_reached(const SeededCells& cells, const FreeSpace& space, const Vec3& place);

} // namespace hyoryu
