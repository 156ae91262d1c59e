// SPDX-License-Identifier: MIT
// Cells near the surface are found from coarse blocks to fine ones: a block whose centre is farther
// from the surface than its corners and the layers reach has none.
#include "mesh_points.hpp"

#include "fill_region.hpp"

#include "hyoryu/core/parallel.hpp"

namespace hyoryu {

namespace {

constexpr Index block = 8; // cells along an edge of the coarsest blocks; a power of two

// A row of blocks along x: the cells of it that may be within the layers.
class BlockRow {
public:
    BlockRow(const Cells& lattice, const TriangleTree& tree, const DepthRange& range, Index j,
             Index k)
        : lattice_(lattice), tree_(tree), range_(range), first_{0, j, k},
          wanted_(at(lattice.count[0] * block * block), 0)
    {
        for (Index i = 0; i < lattice.count[0]; i += block) {
            look({i, j, k}, block);
        }
    }

    // Appends the points of the plane `k` of the row.
    void append_plane(Index k, std::vector<MeshPoint>& points) const
    {
        const auto [nx, ny, nz] = lattice_.count;
        const Index last = std::min(first_[1] + block, ny);
        for (Index j = first_[1]; k < nz && j < last; ++j) {
            for (Index i = 0; i < nx; ++i) {
                if (wanted_[place_of({i, j, k})] == 0) {
                    continue;
                }
                const Vec3 p = lattice_.middle({i, j, k});
                const NearestPlace nearest = nearest_place(tree_, p, range_.below);
                if (nearest.distance < range_.above) {
                    points.push_back({i + nx * (j + ny * k), p, nearest});
                }
            }
        }
    }

private:
    std::size_t place_of(const std::array<Index, 3>& cell) const
    {
        return at(cell[0] +
                  lattice_.count[0] * (cell[1] - first_[1] + block * (cell[2] - first_[2])));
    }

    // Looks at a cube of `edge` cells, of which some may lie outside of the lattice.
    void look(const std::array<Index, 3>& low, Index edge)
    {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (low[axis] >= lattice_.count[axis]) {
                return;
            }
        }
        if (edge == 1) {
            wanted_[place_of(low)] = 1;
            return;
        }
        const Vec3 half = 0.5 * static_cast<double>(edge - 1) * lattice_.edges();
        const double reach = 1.001 * half.norm(); // to the farthest of its points, with rounding
        const Vec3 centre = lattice_.middle(low) + half;
        const double distance = nearest_place(tree_, centre, range_.below + reach).distance;
        if (distance >
            reach + range_.above) { // all outside, or the surface is farther than the layers
            return;
        }
        const Index half_edge = edge / 2;
        for (int child = 0; child < 8; ++child) {
            look({low[0] + (child & 1) * half_edge, low[1] + (child >> 1 & 1) * half_edge,
                  low[2] + (child >> 2) * half_edge},
                 half_edge);
        }
    }

    const Cells& lattice_;
    const TriangleTree& tree_;
    DepthRange range_;
    std::array<Index, 3> first_;
    std::vector<std::uint8_t> wanted_;
};

} // namespace

Cells mesh_lattice(const MeshShape& mesh, double spacing)
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

std::vector<MeshPoint> points_within(const Cells& lattice, const TriangleTree& tree,
                                     const DepthRange& range, Comm* comm)
{
    const Index rows = (lattice.count[1] + block - 1) / block;
    const Index levels = (lattice.count[2] + block - 1) / block;
    // By level, plane within it and row: the order of numbers.
    std::vector<std::vector<MeshPoint>> parts(at(levels * block * rows));
    constexpr Index worth = 2;
    const FillPart own = part_of(levels * rows, comm);
    parallel_blocks(
        own.first, own.last,
        [&](Index k) {
            const Index level = k / rows;
            const Index row = k % rows;
            const BlockRow cells_of(lattice, tree, range, row * block, level * block);
            for (Index plane = 0; plane < block; ++plane) {
                cells_of.append_plane(level * block + plane,
                                      parts[at((level * block + plane) * rows + row)]);
            }
        },
        worth);
    std::vector<MeshPoint> points;
    for (std::vector<MeshPoint>& part : parts) {
        points.insert(points.end(), part.begin(), part.end());
        part = {};
    }
    const bool none = sum_of_all(comm, static_cast<Index>(points.size())) == 0;
    if (none && (comm == nullptr || comm->rank() == 0)) {
        const NearestPlace nearest = nearest_place(tree, lattice.centre, infinity);
        if (std::abs(nearest.distance) <= range.below) {
            points.push_back({lattice.number(), lattice.centre, nearest});
        }
    }
    return points;
}

} // namespace hyoryu
