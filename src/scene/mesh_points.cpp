// SPDX-License-Identifier: MIT
#include "mesh_points.hpp"

#include "hyoryu/core/parallel.hpp"

#include <array>

namespace hyoryu {

namespace {

struct MeshLattice {
    Vec3 centre{0, 0, 0}, size{0, 0, 0}; // of the box of the mesh [m]
    std::array<Index, 3> count{};        // of cells

    Vec3 place(Index i, Index j, Index k) const
    {
        return centre + Vec3{middle(i, count[0], size.x()), middle(j, count[1], size.y()),
                             middle(k, count[2], size.z())};
    }
};

MeshLattice lattice_over(const MeshShape& mesh, double spacing)
{
    Bounds box;
    for (const Vec3& corner : mesh.corners) {
        box.add(corner);
    }
    const Vec3 size = box.max - box.min;
    return {(box.min + box.max) / 2,
            size,
            {cells(size.x(), spacing), cells(size.y(), spacing), cells(size.z(), spacing)}};
}

std::vector<MeshPoint> points_of_plane(const MeshLattice& lattice, const TriangleTree& tree,
                                       Index k, double depth)
{
    std::vector<MeshPoint> points;
    for (Index j = 0; j < lattice.count[1]; ++j) {
        for (Index i = 0; i < lattice.count[0]; ++i) {
            const Vec3 p = lattice.place(i, j, k);
            const NearestPlace nearest = nearest_place(tree, p, depth);
            if (nearest.distance < 0) {
                points.push_back({p, nearest});
            }
        }
    }
    return points;
}

} // namespace

MeshPoints points_within(const MeshShape& mesh, const TriangleTree& tree, double spacing,
                         double depth)
{
    const MeshLattice lattice = lattice_over(mesh, spacing);
    const auto [nx, ny, nz] = lattice.count;
    std::vector<std::vector<MeshPoint>> planes(static_cast<std::size_t>(nz));
    constexpr Index worth = 2;
    parallel_blocks(
        0, nz,
        [&](Index k) {
            planes[static_cast<std::size_t>(k)] = points_of_plane(lattice, tree, k, depth);
        },
        worth);
    MeshPoints found{
        .points = {},
        .cell = lattice.size.cwiseQuotient(
            Vec3(static_cast<double>(nx), static_cast<double>(ny), static_cast<double>(nz)))};
    for (const auto& plane : planes) {
        found.points.insert(found.points.end(), plane.begin(), plane.end());
    }
    if (found.points.empty()) {
        const NearestPlace nearest = nearest_place(tree, lattice.centre, infinity);
        if (std::abs(nearest.distance) <= depth) {
            found.points.push_back({lattice.centre, nearest});
        }
    }
    return found;
}

} // namespace hyoryu
