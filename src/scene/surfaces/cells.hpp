// SPDX-License-Identifier: MIT
// A box cut into equal cells along the axes of the scene.
#pragma once

#include "hyoryu/core/types.hpp"

#include <array>

namespace hyoryu {

/// A box of cells; in two dimensions y does not count.
struct Cells {
    Vec3 centre{0, 0, 0}; // of the box [m]
    Vec3 length{0, 0, 0}; // of its edges [m]
    std::array<Index, 3> count{1, 1, 1};

    Index number() const { return count[0] * count[1] * count[2]; }
    double edge(int axis) const { return length[axis] / static_cast<double>(count[at(axis)]); }
    Vec3 edges() const { return {edge(0), edge(1), edge(2)}; }
    Vec3 middle(const std::array<Index, 3>& cell) const
    {
        Vec3 p = centre;
        for (int a = 0; a < 3; ++a) {
            const auto cells = static_cast<double>(count[at(a)]);
            const double part = (static_cast<double>(cell[at(a)]) + 0.5) / cells - 0.5;
            p[a] += part * length[a];
        }
        return p;
    }
};

/// Whether there is a coordinate axis; in two dimensions there is none along y.
inline bool has_axis(int dimensions, int axis)
{
    return dimensions == 3 || axis != 1;
}

/// The volume of one cell; in two dimensions its area.
inline double volume_of(const Cells& cells, int dimensions)
{
    return cells.edge(0) * cells.edge(2) * (dimensions == 3 ? cells.edge(1) : 1);
}

/// The numbers along the axes of cell k, the first axis fastest.
inline std::array<Index, 3> cell_at(Index k, const std::array<Index, 3>& count)
{
    return {k % count[0], k / count[0] % count[1], k / count[0] / count[1]};
}

/// Calls f(cell) for every cell, by its numbers along the axes.
inline void over_cells(const std::array<Index, 3>& count, const auto& f)
{
    const Index number = count[0] * count[1] * count[2];
    for (Index k = 0; k < number; ++k) {
        f(cell_at(k, count));
    }
}

} // namespace hyoryu
