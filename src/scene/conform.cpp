// SPDX-License-Identifier: MIT
#include "conform.hpp"

#include "hyoryu/core/cell_grid.hpp"
#include "hyoryu/core/kernel.hpp"
#include "hyoryu/core/parallel.hpp"
#include "hyoryu/scene/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hyoryu {

namespace {

constexpr int layers = 3; // that the fluid sees: the support of the widest usual kernel

std::size_t at(Index k)
{
    return static_cast<std::size_t>(k);
}

// The place of the surface nearest to a point, among those in a direction that differs from the
// ones taken by more than 40 degrees; infinitely far if there is none.
Vec3 nearest_elsewhere(const MeshShape& mesh, const Vec3& p, std::span<const Vec3> taken)
{
    constexpr double alike = 0.77; // cosine of the angle
    Vec3 best = Vec3::Constant(infinity);
    double least = infinity;
    for (const auto& triangle : mesh.triangles) {
        const Vec3 q = closest_on_triangle(mesh, triangle, p);
        const double distance = (q - p).norm();
        const bool new_side = std::ranges::none_of(
            taken, [&](const Vec3& n) { return (q - p).dot(n) > alike * distance; });
        if (distance < least && distance > 0 && new_side) {
            least = distance;
            best = q;
        }
    }
    return best;
}

// A point moved to layers below the sides of the surface that are near, at most three of them;
// whether there was one.
bool snap(const MeshShape& mesh, double spacing, Vec3& p)
{
    std::array<Vec3, 3> taken;
    for (std::size_t side = 0; side < taken.size(); ++side) {
        const Vec3 q = nearest_elsewhere(mesh, p, std::span(taken).first(side));
        const double depth = (q - p).norm();
        if (!(depth < layers * spacing)) {
            return side > 0;
        }
        taken[side] = (q - p) / depth;
        p += (depth - (std::floor(depth / spacing) + 0.5) * spacing) * taken[side];
    }
    return true;
}

// sum V F r over the points about one, which points to where they are dense [1/m].
Vec3 crowding(const CellGrid& grid, std::span<const Vec3> points, const Kernel& kernel,
              double volume, Index i)
{
    const auto home = grid.cell_of(points[at(i)]);
    Vec3 sum(0, 0, 0);
    for (Index z = std::max<Index>(home[2] - 1, 0); z < std::min(home[2] + 2, grid.count[2]); ++z) {
        for (Index y = std::max<Index>(home[1] - 1, 0); y < std::min(home[1] + 2, grid.count[1]);
             ++y) {
            const Index row = (z * grid.count[1] + y) * grid.count[0];
            const Index first = row + std::max<Index>(home[0] - 1, 0);
            const Index last = row + std::min(home[0] + 2, grid.count[0]);
            for (Index k = grid.start[at(first)]; k < grid.start[at(last)]; ++k) {
                const Vec3 r = points[at(i)] - points[at(grid.order[at(k)])];
                sum += volume * kernel(Vec<real>{r.x(), r.y(), r.z()}).f * r;
            }
        }
    }
    return sum;
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
}

} // namespace hyoryu
