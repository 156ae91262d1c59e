// SPDX-License-Identifier: MIT
#include "stand_off.hpp"

#include "displace.hpp"
#include "free_space.hpp"
#include "near_points.hpp"

#include "hyoryu/core/parallel.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// In spacings.
constexpr double clearly = 0.45; // nearer than that to a surface; cells are rounded to as near
constexpr double apart = 0.875;  // distance to which pairs are moved
constexpr double around = 2.5;   // radius about moved particles in which others move away
constexpr double crowded = 0.4;  // nearer than that, a pair is parted
constexpr double parted = 0.6;   // distance to which it is moved

std::size_t at(Index row)
{
    return static_cast<std::size_t>(row);
}

// Rows of the points in the cells that a box reaches.
std::vector<std::size_t> rows_in(const CellGrid& grid, const Bounds& box)
{
    const auto low = grid.cell_of(box.min);
    const auto high = grid.cell_of(box.max);
    const auto first = [&](std::size_t a) { return std::max<Index>(low[a], 0); };
    const auto last = [&](std::size_t a) { return std::min(high[a] + 1, grid.count[a]); };
    std::vector<std::size_t> rows;
    for (Index z = first(2); z < last(2); ++z) {
        for (Index y = first(1); y < last(1) && first(0) < last(0); ++y) {
            const Index row = (z * grid.count[1] + y) * grid.count[0];
            for (Index k = grid.start[at(row + first(0))]; k < grid.start[at(row + last(0))]; ++k) {
                rows.push_back(at(grid.order[at(k)]));
            }
        }
    }
    return rows;
}

// Rows of the fluid that are clearly too near to a body.
std::vector<std::uint8_t> too_near(const Scene& scene, const std::vector<Vec3>& points)
{
    std::vector<std::uint8_t> near(points.size(), 0);
    CellGrid grid;
    build(grid, points, 0, around * scene.spacing);
    for (const BodySettings& body : scene.bodies) {
        const Placed shape = placed(body, scene.dimensions);
        Bounds box = bounds(shape);
        box.min -= Vec3::Constant(scene.spacing);
        box.max += Vec3::Constant(scene.spacing);
        const std::vector<std::size_t> rows = rows_in(grid, box);
        parallel_for(0, static_cast<Index>(rows.size()), [&](Index k) {
            const Vec3& p = points[rows[at(k)]];
            const bool in_box =
                (p.array() >= box.min.array()).all() && (p.array() <= box.max.array()).all();
            if (in_box && signed_distance(shape, p) < clearly * scene.spacing) {
                near[rows[at(k)]] = 1;
            }
        });
    }
    return near;
}

// Half of the lacking distance in every pair of point k, away from the other point [m].
Vec3 way_apart(const CellGrid& grid, const std::vector<Vec3>& points, std::size_t k,
               double distance)
{
    Vec3 way = Vec3::Zero();
    for_cells_about(grid, points[k], [&](std::size_t j) {
        const Vec3 r = points[k] - points[j];
        const double length = r.norm();
        if (j != k && length < distance) {
            const Vec3 sideways = (k < j ? 1.0 : -1.0) * Vec3::UnitX();
            way += 0.5 * (distance - length) * (length > 0 ? Vec3(r / length) : sideways);
        }
    });
    return way;
}

// The nearest place about a point that has a distance from all surfaces, on spheres of growing
// radius: where solids touch, the way out of each one leads into the other. None within two
// distances: the point stays.
Vec3 step_aside(const FreeSpace& space, std::span<const int> among, double distance,
                const Vec3& point)
{
    constexpr int spheres = 8; // a quarter of the distance apart
    constexpr int directions = 27;
    for (int sphere = 1; sphere <= spheres; ++sphere) {
        for (int k = 0; k < directions; ++k) {
            const Vec3 way = Vec3(k % 3, k / 3 % 3, k / 9) - Vec3::Constant(1);
            if (way == Vec3(0, 0, 0) || (space.dimensions() == 2 && way.y() != 0)) {
                continue;
            }
            const Vec3 place = point + 0.25 * sphere * distance * way.normalized();
            if (space.nearest(place, among).distance >= distance) {
                return place;
            }
        }
    }
    return point;
}

// Moves pairs to a distance of which at least one is free to, and keeps those off the surfaces.
void relax(const FreeSpace& space, double spacing, double distance,
           const std::vector<std::uint8_t>& is_free, std::vector<Vec3>& points)
{
    constexpr int rounds = 40;
    constexpr double roam = 3; // spacings: farther than anything is moved
    std::vector<std::vector<int>> solids(points.size());
    parallel_for(0, static_cast<Index>(points.size()),
                 [&](Index k) { solids[at(k)] = space.about(points[at(k)], roam * spacing); });
    for (int round = 0; round < rounds; ++round) {
        CellGrid grid;
        build(grid, points, 0, spacing);
        std::vector<Vec3> moved = points;
        parallel_for(0, static_cast<Index>(points.size()), [&](Index k) {
            if (is_free[at(k)] != 0) {
                Vec3& p = moved[at(k)];
                p += way_apart(grid, points, at(k), distance);
                if (space.nearest(p, solids[at(k)]).distance < clearly * spacing &&
                    !step_off(space, solids[at(k)], spacing / 2, p)) {
                    p = step_aside(space, solids[at(k)], spacing / 2, points[at(k)]);
                }
            }
        });
        points = std::move(moved);
    }
}

// Moves pairs of which one is within a radius about marked particles to a distance [m].
void move_apart(const Scene& scene, std::span<const std::uint8_t> marked, double radius,
                double distance, Filling& filling)
{
    if (std::ranges::find(marked, 1) == marked.end()) {
        return;
    }
    const std::vector<std::uint8_t> giving = marks_about(filling.fluid, marked, radius);
    const std::vector<std::uint8_t> seen = marks_about(filling.fluid, giving, scene.spacing);
    std::vector<std::size_t> rows;
    std::vector<Vec3> points;
    std::vector<std::uint8_t> is_free;
    for (std::size_t k = 0; k < seen.size(); ++k) {
        if (seen[k] != 0) {
            rows.push_back(k);
            points.push_back(filling.fluid[k]);
            is_free.push_back(giving[k]);
        }
    }
    relax(FreeSpace(scene), scene.spacing, distance, is_free, points);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        Vec3& p = filling.fluid[rows[k]];
        if (scene.gravity.norm() > 0) {
            filling.fluid_depth[rows[k]] += height(scene, p) - height(scene, points[k]);
        }
        p = points[k];
    }
}

// Rows of the fluid about surfaces that are much nearer to another particle than a spacing.
std::vector<std::uint8_t> in_pairs(const Filling& filling, double spacing)
{
    const double distance = crowded * spacing;
    const std::vector<Vec3>& points = filling.fluid;
    CellGrid grid;
    build(grid, points, 0, spacing); // smaller cells would be many for each particle
    std::vector<std::uint8_t> near(points.size(), 0);
    parallel_for(0, static_cast<Index>(points.size()), [&](Index k) {
        const auto row = at(k);
        if (filling.fluid_cut[row] != 0) {
            for_cells_about(grid, points[row], [&](std::size_t other) {
                const bool is_near = (points[other] - points[row]).norm() < distance;
                near[row] = other != row && is_near ? 1 : near[row];
            });
        }
    });
    return near;
}

} // namespace

void stand_off_bodies(const Scene& scene, Filling& filling)
{
    const double spacing = scene.spacing;
    move_apart(scene, too_near(scene, filling.fluid), around * spacing, apart * spacing, filling);
}

void part_pairs(const Scene& scene, Filling& filling)
{
    const double spacing = scene.spacing;
    if (std::ranges::find(filling.fluid_cut, 1) != filling.fluid_cut.end()) {
        move_apart(scene, in_pairs(filling, spacing), around * spacing, parted * spacing, filling);
    }
}

} // namespace hyoryu
