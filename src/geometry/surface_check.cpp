// SPDX-License-Identifier: MIT
#include "hyoryu/geometry/surface_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

// The heights on a lattice, as cells of two triangles.
class Lattice {
public:
    Lattice(const TerrainPatch& patch, const std::vector<double>& heights)
        : patch_(patch), heights_(heights), cells_(lattice_cells(patch))
    {
        for (std::size_t axis = 0; axis < 2; ++axis) {
            edge_[axis] =
                (patch.extent[axis + 2] - patch.extent[axis]) / static_cast<double>(cells_[axis]);
        }
    }

    const std::array<Index, 2>& cells() const { return cells_; }
    Plan2 middle(Index i, Index j) const
    {
        return {patch_.extent[0] + (static_cast<double>(i) + 0.5) * edge_[0],
                patch_.extent[1] + (static_cast<double>(j) + 0.5) * edge_[1]};
    }
    // Corners from the lower left one, counter-clockwise.
    std::array<double, 4> corners(Index i, Index j) const
    {
        return {height(i, j), height(i + 1, j), height(i + 1, j + 1), height(i, j + 1)};
    }
    // The surface at a place within the window.
    double surface(const Plan2& place) const
    {
        std::array<Index, 2> cell{};
        std::array<double, 2> part{};
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const double along = (place[axis] - patch_.extent[axis]) / edge_[axis];
            cell[axis] = std::clamp(static_cast<Index>(along), Index(0), cells_[axis] - 1);
            part[axis] = along - static_cast<double>(cell[axis]);
        }
        const auto [a, b, c, d] = corners(cell[0], cell[1]);
        const auto [s, t] = part;
        if (std::abs(a - c) <= std::abs(b - d)) { // along the diagonal from a to c
            return s >= t ? a + s * (b - a) + t * (c - b) : a + t * (d - a) + s * (c - d);
        }
        return s + t <= 1 ? a + s * (b - a) + t * (d - a)
                          : c + (1 - s) * (d - c) + (1 - t) * (b - c);
    }
    // The tangent of the steeper triangle of a cell.
    double steepness(Index i, Index j) const
    {
        const auto [a, b, c, d] = corners(i, j);
        const auto slope = [&](double along_x, double along_y) {
            return std::hypot(along_x / edge_[0], along_y / edge_[1]);
        };
        return std::abs(a - c) <= std::abs(b - d)
                   ? std::max(slope(b - a, c - b), slope(c - d, d - a))
                   : std::max(slope(b - a, d - a), slope(c - d, c - b));
    }

private:
    double height(Index i, Index j) const { return heights_[at(j * (cells_[0] + 1) + i)]; }

    const TerrainPatch& patch_;
    const std::vector<double>& heights_;
    std::array<Index, 2> cells_;
    std::array<double, 2> edge_{};
};

bool is_level(const TerrainPatch& patch, const Plan2& place)
{
    return std::ranges::any_of(patch.levels,
                               [&](const LevelArea& level) { return holds(level.corners, place); });
}

void look_for_steps(const Lattice& lattice, SurfaceCheck& check)
{
    for (Index j = 0; j < lattice.cells()[1]; ++j) {
        for (Index i = 0; i < lattice.cells()[0]; ++i) {
            if (!(lattice.steepness(i, j) > 1)) {
                continue;
            }
            ++check.steep;
            const auto corners = lattice.corners(i, j);
            const auto [low, high] = std::ranges::minmax(corners);
            if (high - low > check.step) {
                check.step = high - low;
                check.step_at = lattice.middle(i, j);
            }
        }
    }
}

} // namespace

SurfaceCheck check_surface(const HeightGrid& grid, const TerrainPatch& patch,
                           const std::vector<double>& heights)
{
    const Lattice lattice(patch, heights);
    SurfaceCheck check{.cells = lattice.cells()};
    const auto [low, high] = std::ranges::minmax(heights);
    check.lowest = low;
    check.highest = high;
    const double azimuth = patch.azimuth_deg * std::numbers::pi / 180;
    double sum = 0;
    for (Index k = 0; k < grid.columns * grid.rows; ++k) {
        const Index column = k % grid.columns;
        const Index row = k / grid.columns;
        const double east =
            grid.first[0] - patch.origin[0] + static_cast<double>(column) * grid.cell[0];
        const double north =
            grid.first[1] - patch.origin[1] + static_cast<double>(row) * grid.cell[1];
        const Plan2 place{east * std::sin(azimuth) + north * std::cos(azimuth),
                          north * std::sin(azimuth) - east * std::cos(azimuth)};
        const bool inside = place[0] >= patch.extent[0] && place[0] <= patch.extent[2] &&
                            place[1] >= patch.extent[1] && place[1] <= patch.extent[3];
        const double z = grid.height[at(k)];
        if (!inside || std::isnan(z) || is_level(patch, place)) {
            continue;
        }
        const double difference = z + patch.datum - lattice.surface(place);
        ++check.compared;
        sum += difference * difference;
        if (std::abs(difference) > check.largest) {
            check.largest = std::abs(difference);
            check.at = place;
        }
    }
    check.rms = check.compared > 0 ? std::sqrt(sum / static_cast<double>(check.compared)) : 0;
    look_for_steps(lattice, check);
    return check;
}

} // namespace hyoryu
