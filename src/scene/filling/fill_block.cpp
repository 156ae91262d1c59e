// SPDX-License-Identifier: MIT
#include "fill_block.hpp"

#include "columns.hpp"
#include "scene/surfaces/along_ray.hpp"
#include "scene/surfaces/seeded_water.hpp"
#include "shape_points.hpp"

#include "hyoryu/core/parallel.hpp"
#include "hyoryu/scene/fill.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hyoryu {

namespace {

// Largest relative error of the volume of cells that count as cubes of the spacing.
constexpr double volume_tolerance = 0.02;
// A particle fits where it has this part of a cell's shortest edge to the nearest surface; or is
// as deep in a wall.
constexpr double fitting = 0.45;
// A face is covered by walls if they are deeper than this part of a spacing on all of it.
constexpr double thinnest_covered = 1e-6;

double shortest_edge(const Cells& cells, int dimensions)
{
    const double least = std::min(cells.edge(0), cells.edge(2));
    return dimensions == 3 ? std::min(least, cells.edge(1)) : least;
}

// Whether an edge differs from the spacing by so much that the lattice would rearrange.
bool is_stretched(const Cells& cells, double spacing, int dimensions)
{
    constexpr double stretched = 0.025; // of the spacing
    bool any = false;
    for (int a = 0; a < 3; ++a) {
        any = any || (has_axis(dimensions, a) && std::abs(cells.edge(a) / spacing - 1) > stretched);
    }
    return any;
}

// Rounds a half up even where round-off has reduced it, so that a block has the same cells wherever
// it lies.
Index whole(double number)
{
    constexpr double round_off = 1e-9;
    return std::max<Index>(1, std::llround(number * (1 + round_off)));
}

// Cells nearest to cubes of the spacing.
Cells plain_cells(const Bounds& box, double spacing, int dimensions)
{
    Cells cells{(box.min + box.max) / 2, box.max - box.min};
    for (int a = 0; a < 3; ++a) {
        cells.count[at(a)] = has_axis(dimensions, a) ? whole(cells.length[a] / spacing) : 1;
    }
    return cells;
}

// Cells of the volume of cubes of the spacing: each edge compensates the rounding of the shorter
// ones, in equal parts with the longer ones.
Cells even_cells(const Bounds& box, double spacing, int dimensions)
{
    Cells cells = plain_cells(box, spacing, dimensions);
    std::vector<int> axes;
    for (int a = 0; a < 3; ++a) {
        if (has_axis(dimensions, a)) {
            axes.push_back(a);
        }
    }
    std::ranges::stable_sort(axes, {}, [&](int a) { return cells.length[a]; });
    double rest = std::pow(spacing, dimensions);
    for (std::size_t k = 0; k < axes.size(); ++k) {
        const int a = axes[k];
        const double wanted = std::pow(rest, 1.0 / static_cast<double>(axes.size() - k));
        cells.count[at(a)] = whole(cells.length[a] / wanted);
        rest /= cells.edge(a);
    }
    return cells;
}

// The middles of the cells of this process.
std::vector<Vec3> middles_in(const Placed& block, const Cells& cells, const Comm* comm)
{
    std::vector<Vec3> points;
    const FillPart own = part_of(cells.number(), comm);
    for (Index k = own.first; k < own.last; ++k) {
        const Vec3 p = cells.middle(cell_at(k, cells.count));
        if (signed_distance(block, p) < 0) {
            points.push_back(p);
        }
    }
    return points;
}

// The free points among some points, and whether the points of all processes fit the walls.
struct Fit {
    std::vector<Vec3> points;
    bool fits = true;
};

Fit fit(const FreeSpace& space, std::vector<Vec3> points, double edge, Comm* comm)
{
    std::vector<double> clearance(points.size());
    parallel_for(0, static_cast<Index>(points.size()),
                 [&](Index k) { clearance[at(k)] = space.clearance(points[at(k)]); });
    Fit result;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        result.fits = result.fits && std::abs(clearance[k]) >= fitting * edge;
        if (clearance[k] >= 0) {
            points[kept++] = points[k];
        }
    }
    points.resize(kept);
    result.points = std::move(points);
    result.fits = sum_of_all(comm, result.fits ? 0 : 1) == 0;
    return result;
}

// The depth to which walls cover a whole face of a box.
double covered_depth(const Scene& scene, const FreeSpace& space, const Bounds& box, int axis,
                     double way)
{
    const Cells cells = plain_cells(box, scene.spacing, scene.dimensions);
    std::array<Index, 3> count = cells.count;
    count[at(axis)] = 1;
    const double first = thinnest_covered * scene.spacing;
    const auto clearance = [&](const Vec3& p) { return space.clearance(p); };
    double depth = cells.length[axis];
    over_cells(count, [&](const std::array<Index, 3>& cell) {
        AxisRay ray{cells.middle(cell), way * Vec3::Unit(axis)};
        ray.from[axis] = way > 0 ? box.min[axis] : box.max[axis];
        if (depth > 0) {
            const bool open = clearance(ray.at(first)) > 0;
            depth = open ? 0 : next_change(ray, first, depth, scene.spacing / 64, clearance);
        }
    });
    return depth;
}

// A box less the slabs at its faces that walls cover; empty if they cover all of it.
Bounds uncovered(const Scene& scene, const FreeSpace& space, Bounds box)
{
    for (int a = 0; a < 3; ++a) {
        if (has_axis(scene.dimensions, a)) {
            box.min[a] += covered_depth(scene, space, box, a, 1);
            if (box.max[a] - box.min[a] <= thinnest_covered * scene.spacing) {
                return {};
            }
            box.max[a] -= covered_depth(scene, space, box, a, -1);
        }
    }
    return box;
}

// Points in layers below the surface of a block: those of this process, and the volume of one.
struct LayerPoints {
    std::vector<Vec3> points;
    double volume = 0; // [m3], [m2] in two dimensions
};

LayerPoints layers_of(const Scene& scene, const FluidBlock& block, const Comm* comm)
{
    const auto points_of = [&](const auto& shape) -> ShapePoints {
        if constexpr (requires { shape_points(shape, scene.spacing, scene.dimensions); }) {
            return shape_points(shape, scene.spacing, scene.dimensions);
        } else {
            expects(false); // the reader knows no layers of other shapes
            return {};
        }
    };
    const ShapePoints all = std::visit(points_of, block.shape);
    const FillPart own = part_of(number_of(all), comm);
    LayerPoints layers;
    layers.volume = volume(block.shape, scene.dimensions) / static_cast<double>(number_of(all));
    for (Index k = own.first; k < own.last; ++k) {
        layers.points.emplace_back(block.centre + block.rotation * point_of(all, k).place);
    }
    return layers;
}

} // namespace

BlockParticles fill_block(const Scene& scene, std::size_t block, Comm* comm)
{
    const FluidBlock& own = scene.fluid->blocks[block];
    const Placed shape = placed(own, scene.dimensions);
    const FreeSpace space(scene, block);
    const int d = scene.dimensions;
    const Cells plain = plain_cells(bounds(shape), scene.spacing, d);
    LayerPoints first = own.layers
                            ? layers_of(scene, own, comm)
                            : LayerPoints{middles_in(shape, plain, comm), volume_of(plain, d)};
    BlockParticles result{.cell = first.volume};
    result.all = sum_of_all(comm, static_cast<Index>(first.points.size()));
    result.in_walls = sum_of_all(comm, std::ranges::count_if(first.points, [&](const Vec3& p) {
                                     return space.is_in_wall(p);
                                 }));
    const double cube = std::pow(scene.spacing, d);
    Fit found = fit(space, std::move(first.points),
                    own.layers ? scene.spacing : shortest_edge(plain, d), comm);
    if (!found.fits ||
        (!own.layers && std::abs(volume_of(plain, d) / cube - 1) > volume_tolerance)) {
        const Bounds box = uncovered(scene, space, bounds(shape));
        if (box.empty()) {
            return result;
        }
        const Cells even = even_cells(box, scene.spacing, d);
        found = fit(space, middles_in(shape, even, comm), shortest_edge(even, d), comm);
        result.cell = volume_of(even, d);
        result.cut = is_stretched(even, scene.spacing, d);
        if (!found.fits) {
            ColumnParticles columns = in_columns(scene, space, shape, even, comm);
            found.points = std::move(columns.points);
            result.cell = columns.cell;
            result.cut = true;
        }
    }
    result.points = std::move(found.points);
    if (own.seeded) {
        const SeededCells cells = seeded_cells(scene, block, bounds(shape));
        std::erase_if(result.points, [&](const Vec3& p) { return !is_reached(cells, space, p); });
        result.in_walls = 0; // the box about the water is ours, not the user's
    }
    return result;
}

} // namespace hyoryu
