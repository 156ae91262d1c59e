// SPDX-License-Identifier: MIT
#include "conform.hpp"

#include "near_points.hpp"

#include "hyoryu/core/kernel.hpp"
#include "hyoryu/core/parallel.hpp"
#include "hyoryu/scene/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hyoryu {

namespace {

constexpr int layers = 3; // that the fluid sees: the support of the widest usual kernel

// A side of the surface as seen from a point within.
struct Side {
    double depth = infinity; // below it [m]
    Vec3 outward{0, 0, 0};   // unit
};

// The nearest triangle that faces the point and is turned against the ones taken by more than 75
// degrees: coplanar ones are one side, and at a blunt edge the particles of both sides would meet.
Side nearest_side(const MeshShape& mesh, double spacing, const Vec3& p, std::span<const Side> taken)
{
    constexpr double facing = 0.77; // cosines of the angles
    constexpr double alike = 0.25;
    Side best;
    for (const auto& triangle : mesh.triangles) {
        const auto corner = [&](std::size_t k) { return mesh.corners[at(triangle[k])]; };
        const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
        const Vec3 way = closest_on_triangle(mesh, triangle, p) - p;
        const double depth = way.norm();
        const bool faces = way.dot(normal) > facing * depth || depth < 0.01 * spacing;
        const bool is_new = std::ranges::none_of(
            taken, [&](const Side& t) { return normal.dot(t.outward) > alike; });
        if (depth < best.depth && faces && is_new) {
            best = {depth, normal};
        }
    }
    return best;
}

// A point moved to layers below the sides of the surface that are near, at most three of them;
// whether there was one.
bool snap(const MeshShape& mesh, double spacing, Vec3& p)
{
    std::array<Side, 3> taken;
    for (std::size_t k = 0; k < taken.size(); ++k) {
        Side& side = taken[k];
        side = nearest_side(mesh, spacing, p, std::span(taken).first(k));
        if (!(side.depth < layers * spacing)) {
            return k > 0;
        }
        const double wanted = (std::floor(side.depth / spacing) + 0.5) * spacing;
        p += (side.depth - wanted) * side.outward;
    }
    return true;
}

// sum V F r over the points about one, which points to where they are dense [1/m].
Vec3 crowding(const CellGrid& grid, std::span<const Vec3> points, const Kernel& kernel,
              double volume, Index i)
{
    Vec3 sum(0, 0, 0);
    for_cells_about(grid, points[at(i)], [&](std::size_t j) {
        const Vec3 r = points[at(i)] - points[j];
        sum += volume * kernel(Vec<real>{r.x(), r.y(), r.z()}).f * r;
    });
    return sum;
}

// Drops points that are nearer than 0.6 spacings to an earlier one: at a sharp edge the layers of
// its two sides have room for fewer than the lattice had.
void thin(double spacing, std::vector<Vec3>& points)
{
    const double least = 0.6 * spacing;
    CellGrid grid;
    build(grid, points, 0, spacing);
    std::vector<std::uint8_t> kept(points.size(), 1);
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for_cells_about(grid, points[i], [&](std::size_t j) {
            const bool meets = j < i && kept[j] != 0 && (points[i] - points[j]).norm() < least;
            kept[i] = meets ? 0 : kept[i];
        });
        if (kept[i] != 0) {
            result.push_back(points[i]);
        }
    }
    points = std::move(result);
}

} // namespace

void conform_to_surface(const MeshShape& mesh, double spacing, std::vector<Vec3>& points)
{
    constexpr int rounds = 15;
    constexpr double pace = 0.1; // stable: the kernel's second moment is h^2/2
    const auto count = static_cast<Index>(points.size());
    std::vector<std::uint8_t> near(points.size(), 0);
    parallel_for(0, count,
                 [&](Index i) { near[at(i)] = snap(mesh, spacing, points[at(i)]) ? 1 : 0; });
    const Kernel kernel = make_kernel(1.5 * spacing, spacing, 3);
    const double most = 0.1 * spacing;
    for (int round = 0; round < rounds; ++round) {
        CellGrid grid;
        build(grid, points, 0, kernel.support);
        std::vector<Vec3> moved = points;
        parallel_for(0, count, [&](Index i) {
            if (near[at(i)] != 0) {
                const Vec3 S =
                    crowding(grid, points, kernel, spacing * spacing * spacing, i) * sq(kernel.h);
                const double way = pace * S.norm();
                moved[at(i)] -= pace * (way > most ? most / way : 1.0) * S;
                snap(mesh, spacing, moved[at(i)]);
            }
        });
        points = std::move(moved);
    }
    thin(spacing, points);
}

} // namespace hyoryu
