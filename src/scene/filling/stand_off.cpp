// SPDX-License-Identifier: MIT
#include "stand_off.hpp"

#include "displace.hpp"
#include "scene/surfaces/free_space.hpp"
#include "scene/surfaces/near_points.hpp"

#include "hyoryu/core/parallel.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// In spacings.
constexpr double clearly = 0.45; // nearer than that to a surface; cells are rounded to as near
constexpr double distance_apart = 0.875; // distance to which pairs are moved
constexpr double around = 2.5;           // radius about moved particles in which others move away
constexpr double crowded = 0.4;          // nearer than that, a pair is parted
constexpr double parted = 0.6;           // distance to which it is moved

// Rows of the points in the cells that a box reaches.
std::vector<std::size_t> rows_in(const CellGrid& grid, const Bounds& box)
{
    std::vector<std::size_t> rows;
    for_points_in(grid, grid.cell_of(box.min), grid.cell_of(box.max),
                  [&](std::size_t row) { rows.push_back(row); });
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
            const int layer = k / 9;
            const int row = k / 3 % 3;
            const Vec3 way = Vec3(k % 3, row, layer) - Vec3::Constant(1);
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

// Moves pairs with at least one free particle to a distance, and keeps free particles off surfaces.
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

// A particle in the surroundings of pairs, on all processes.
struct Seen {
    std::int64_t number = 0;
    Vec3 place{0, 0, 0};
    std::int64_t is_free = 0;
};

std::vector<Vec3> places_of(const Filling& filling, std::span<const std::uint8_t> marked)
{
    std::vector<Vec3> places;
    for (std::size_t k = 0; k < marked.size(); ++k) {
        if (marked[k] != 0) {
            places.push_back(filling.fluid[k]);
        }
    }
    return places;
}

// The particles that move and those that they see, sorted by number. `centres`: the marked
// particles of all processes.
std::vector<Seen> seen_about(const Scene& scene, Comm* comm, const std::vector<Vec3>& centres,
                             double radius, const Filling& filling)
{
    const std::vector<std::uint8_t> giving = marks_near(filling.fluid, centres, radius);
    const std::vector<Vec3> movers = of_all_ranks(comm, places_of(filling, giving));
    const std::vector<std::uint8_t> seen = marks_near(filling.fluid, movers, scene.spacing);
    std::vector<Seen> own;
    for (std::size_t k = 0; k < seen.size(); ++k) {
        if (seen[k] != 0) {
            own.push_back({filling.number_of_fluid(k), filling.fluid[k], giving[k]});
        }
    }
    std::vector<Seen> all = of_all_ranks(comm, std::move(own));
    std::ranges::sort(all, {}, &Seen::number);
    return all;
}

// Moves pairs of which one is within a radius about marked particles to a distance [m].
void move_apart(const Scene& scene, Comm* comm, std::span<const std::uint8_t> marked, double radius,
                double distance, Filling& filling)
{
    const std::vector<Vec3> centres = of_all_ranks(comm, places_of(filling, marked));
    if (centres.empty()) {
        return;
    }
    const std::vector<Seen> seen = seen_about(scene, comm, centres, radius, filling);
    std::vector<Vec3> points;
    std::vector<std::uint8_t> is_free;
    for (const Seen& one : seen) {
        points.push_back(one.place);
        is_free.push_back(one.is_free != 0 ? 1 : 0);
    }
    relax(FreeSpace(scene), scene.spacing, distance, is_free, points);
    std::size_t next = 0; // own particles come in the order of their numbers
    for (std::size_t k = 0; k < filling.fluid.size(); ++k) {
        while (next < seen.size() && seen[next].number < filling.number_of_fluid(k)) {
            ++next;
        }
        if (next == seen.size() || seen[next].number != filling.number_of_fluid(k)) {
            continue;
        }
        Vec3& p = filling.fluid[k];
        if (scene.gravity.norm() > 0) {
            filling.fluid_depth[k] += height(scene, p) - height(scene, points[next]);
        }
        p = points[next];
    }
}

// The first `own` rows of the fluid that are about surfaces and much nearer to another particle
// than a spacing.
std::vector<std::uint8_t> in_pairs(const Filling& filling, std::size_t own, double spacing)
{
    const double distance = crowded * spacing;
    const std::vector<Vec3>& points = filling.fluid;
    CellGrid grid;
    build(grid, points, 0, spacing); // smaller cells would be many for each particle
    std::vector<std::uint8_t> near(own, 0);
    parallel_for(0, static_cast<Index>(own), [&](Index k) {
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

// The same marks for the particles of this process, with copies of those of other processes.
std::vector<std::uint8_t> in_pairs_of_all(const FillRegion& region, double spacing,
                                          Filling& filling)
{
    constexpr double strayed = 1; // spacings that packing moves a particle out of its region
    const std::size_t own = filling.fluid.size();
    const FillHalo halo(region, filling.fluid, (strayed + crowded) * spacing);
    const std::vector<Vec3> copies = halo.fetch(std::span<const Vec3>(filling.fluid));
    filling.fluid.insert(filling.fluid.end(), copies.begin(), copies.end());
    std::vector<std::uint8_t> near = in_pairs(filling, own, spacing);
    filling.fluid.resize(own);
    return near;
}

} // namespace

void stand_off_bodies(const Scene& scene, Filling& filling)
{
    const double spacing = scene.spacing;
    move_apart(scene, nullptr, too_near(scene, filling.fluid), around * spacing,
               distance_apart * spacing, filling);
}

void part_pairs(const Scene& scene, const FillRegion* region, Filling& filling)
{
    Comm* const comm = region != nullptr ? &region->comm() : nullptr;
    const double spacing = scene.spacing;
    const bool any = std::ranges::find(filling.fluid_cut, 1) != filling.fluid_cut.end();
    if (sum_of_all(comm, any ? 1 : 0) == 0) {
        return;
    }
    const std::vector<std::uint8_t> near = region != nullptr
                                               ? in_pairs_of_all(*region, spacing, filling)
                                               : in_pairs(filling, filling.fluid.size(), spacing);
    move_apart(scene, comm, near, around * spacing, parted * spacing, filling);
}

} // namespace hyoryu
