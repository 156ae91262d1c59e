// SPDX-License-Identifier: MIT
#include "hyoryu/geometry/height_grid.hpp"

#include "hyoryu/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

// Easting and northing of a place of the case.
std::array<double, 2> in_grid(const TerrainPatch& patch, double x, double y)
{
    const double azimuth = patch.azimuth_deg * std::numbers::pi / 180;
    const double east = std::sin(azimuth);
    const double north = std::cos(azimuth);
    return {patch.origin[0] + east * x - north * y, patch.origin[1] + north * x + east * y};
}

// The mean height over a rectangle about a place of the case, of samples no farther apart than the
// cells of the grid; the height at the place if there is one sample.
double mean_height(const HeightGrid& grid, const TerrainPatch& patch, std::array<double, 2> place,
                   std::array<double, 2> size)
{
    const auto samples = [&](std::size_t axis) {
        const double cell = std::min(grid.cell[0], grid.cell[1]);
        return std::max<Index>(1, static_cast<Index>(std::ceil(size[axis] / cell - 1e-9)));
    };
    const std::array<Index, 2> count{samples(0), samples(1)};
    const auto sample = [&](std::size_t axis, Index k) {
        const double part = (static_cast<double>(k) + 0.5) / static_cast<double>(count[axis]);
        const double x = place[axis] + (part - 0.5) * size[axis];
        return std::clamp(x, patch.extent[axis], patch.extent[axis + 2]);
    };
    double sum = 0;
    for (Index j = 0; j < count[1]; ++j) {
        for (Index i = 0; i < count[0]; ++i) {
            const auto [easting, northing] = in_grid(patch, sample(0, i), sample(1, j));
            sum += height_at(grid, easting, northing);
        }
    }
    return sum / static_cast<double>(count[0] * count[1]);
}

// The last level area that holds a place of the case, or none.
const LevelArea* level_at(const TerrainPatch& patch, const Plan2& place)
{
    const LevelArea* found = nullptr;
    for (const LevelArea& level : patch.levels) {
        found = holds(level.corners, place) ? &level : found;
    }
    return found;
}

double edge(const TerrainPatch& patch, std::size_t axis)
{
    return (patch.extent[axis + 2] - patch.extent[axis]) /
           static_cast<double>(lattice_cells(patch)[axis]);
}

double coordinate(const TerrainPatch& patch, std::size_t axis, Index k)
{
    const Index cells = lattice_cells(patch)[axis];
    return k == cells ? patch.extent[axis + 2]
                      : patch.extent[axis] + static_cast<double>(k) * edge(patch, axis);
}

// Numbers of the corners at the rim of a lattice of nx x ny corners, counter-clockwise from above.
std::vector<int> rim(Index nx, Index ny)
{
    std::vector<int> corners;
    const auto add = [&](Index i, Index j) { corners.push_back(static_cast<int>(j * nx + i)); };
    for (Index i = 0; i + 1 < nx; ++i) {
        add(i, 0);
    }
    for (Index j = 0; j + 1 < ny; ++j) {
        add(nx - 1, j);
    }
    for (Index i = nx - 1; i > 0; --i) {
        add(i, ny - 1);
    }
    for (Index j = ny - 1; j > 0; --j) {
        add(0, j);
    }
    return corners;
}

void add_ground(const std::vector<double>& heights, Index nx, Index ny, Mesh& mesh)
{
    for (Index j = 0; j + 1 < ny; ++j) {
        for (Index i = 0; i + 1 < nx; ++i) {
            const auto a = static_cast<int>(j * nx + i);
            const auto d = static_cast<int>(a + nx);
            const auto height = [&](int corner) { return heights[at(corner)]; };
            const double up = std::abs(height(a) - height(d + 1));
            const double down = std::abs(height(a + 1) - height(d));
            if (up <= down) {
                mesh.triangles.push_back({a, a + 1, d + 1});
                mesh.triangles.push_back({a, d + 1, d});
            } else {
                mesh.triangles.push_back({a, a + 1, d});
                mesh.triangles.push_back({a + 1, d + 1, d});
            }
        }
    }
}

// Sides and bottom: each corner of the rim has one below it, and one in the middle joins those.
void close_below(const TerrainPatch& patch, Index nx, Index ny, Mesh& mesh)
{
    const std::vector<int> above = rim(nx, ny);
    const auto first = static_cast<int>(mesh.corners.size());
    for (const int corner : above) {
        const Vec3 place = mesh.corners[at(corner)];
        mesh.corners.emplace_back(place.x(), place.y(), patch.bottom);
    }
    const auto middle = static_cast<int>(mesh.corners.size());
    mesh.corners.emplace_back((patch.extent[0] + patch.extent[2]) / 2,
                              (patch.extent[1] + patch.extent[3]) / 2, patch.bottom);
    const auto count = static_cast<int>(above.size());
    for (int k = 0; k < count; ++k) {
        const int next = (k + 1) % count;
        mesh.triangles.push_back({above[at(k)], first + k, first + next});
        mesh.triangles.push_back({above[at(k)], first + next, above[at(next)]});
        mesh.triangles.push_back({middle, first + next, first + k});
    }
}

} // namespace

double height_at(const HeightGrid& grid, double easting, double northing)
{
    const std::array<double, 2> place{(easting - grid.first[0]) / grid.cell[0],
                                      (northing - grid.first[1]) / grid.cell[1]};
    const std::array<Index, 2> count{grid.columns, grid.rows};
    std::array<Index, 2> low{};
    std::array<double, 2> part{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const auto last = static_cast<double>(count[axis] - 1);
        if (!(place[axis] >= -0.5 - 1e-9 && place[axis] <= last + 0.5 + 1e-9)) {
            return std::nan("");
        }
        const double inside = std::clamp(place[axis], 0.0, last);
        low[axis] = std::min(static_cast<Index>(inside), count[axis] - 2);
        part[axis] = inside - static_cast<double>(low[axis]);
    }
    const auto height = [&](Index i, Index j) {
        return grid.height[at((low[1] + j) * grid.columns + low[0] + i)];
    };
    const auto row = [&](Index j) {
        return part[0] == 0   ? height(0, j)
               : part[0] == 1 ? height(1, j)
                              : (1 - part[0]) * height(0, j) + part[0] * height(1, j);
    };
    return part[1] == 0   ? row(0)
           : part[1] == 1 ? row(1)
                          : (1 - part[1]) * row(0) + part[1] * row(1);
}

std::optional<std::array<double, 4>> covered_extent(const HeightGrid& grid,
                                                    const TerrainPatch& patch)
{
    const double quarters = patch.azimuth_deg / 90;
    if (quarters != std::round(quarters)) {
        return std::nullopt;
    }
    const double azimuth = patch.azimuth_deg * std::numbers::pi / 180;
    const double east = std::round(std::sin(azimuth));
    const double north = std::round(std::cos(azimuth));
    std::array<double, 4> extent{infinity, infinity, -infinity, -infinity};
    for (const double column : {0.0, static_cast<double>(grid.columns - 1)}) {
        for (const double row : {0.0, static_cast<double>(grid.rows - 1)}) {
            const double de = grid.first[0] + column * grid.cell[0] - patch.origin[0];
            const double dn = grid.first[1] + row * grid.cell[1] - patch.origin[1];
            const std::array<double, 2> place{east * de + north * dn, -north * de + east * dn};
            for (std::size_t axis = 0; axis < 2; ++axis) {
                extent[axis] = std::min(extent[axis], place[axis]);
                extent[axis + 2] = std::max(extent[axis + 2], place[axis]);
            }
        }
    }
    return extent;
}

std::array<Index, 2> lattice_cells(const TerrainPatch& patch)
{
    const auto cells = [&](std::size_t axis) {
        const double length = patch.extent[axis + 2] - patch.extent[axis];
        return std::max<Index>(1, static_cast<Index>(std::ceil(length / patch.resolution - 1e-9)));
    };
    return {cells(0), cells(1)};
}

std::vector<double> sample_heights(const HeightGrid& grid, const TerrainPatch& patch)
{
    const auto [columns, rows] = lattice_cells(patch);
    std::array<double, 2> size{edge(patch, 0), edge(patch, 1)};
    const double finest = std::min(grid.cell[0], grid.cell[1]);
    for (double& length : size) { // a lattice as fine as the grid takes its heights
        length = length > finest * (1 + 1e-9) ? length : 0;
    }
    std::vector<double> heights;
    heights.reserve(at((columns + 1) * (rows + 1)));
    for (Index j = 0; j <= rows; ++j) {
        for (Index i = 0; i <= columns; ++i) {
            const Plan2 place{coordinate(patch, 0, i), coordinate(patch, 1, j)};
            const LevelArea* level = level_at(patch, place);
            heights.push_back(
                level != nullptr ? level->z : patch.datum + mean_height(grid, patch, place, size));
        }
    }
    return heights;
}

Index points_within(const TerrainPatch& patch, const Ring& ring)
{
    const auto [columns, rows] = lattice_cells(patch);
    Index count = 0;
    for (Index j = 0; j <= rows; ++j) {
        for (Index i = 0; i <= columns; ++i) {
            count += holds(ring, {coordinate(patch, 0, i), coordinate(patch, 1, j)}) ? 1 : 0;
        }
    }
    return count;
}

Mesh terrain_mesh(const TerrainPatch& patch, const std::vector<double>& heights)
{
    const auto [columns, rows] = lattice_cells(patch);
    const Index nx = columns + 1;
    const Index ny = rows + 1;
    expects(static_cast<Index>(heights.size()) == nx * ny);
    Mesh mesh;
    for (Index j = 0; j < ny; ++j) {
        for (Index i = 0; i < nx; ++i) {
            mesh.corners.emplace_back(coordinate(patch, 0, i), coordinate(patch, 1, j),
                                      heights[at(j * nx + i)]);
        }
    }
    add_ground(heights, nx, ny, mesh);
    close_below(patch, nx, ny, mesh);
    return mesh;
}

} // namespace hyoryu
