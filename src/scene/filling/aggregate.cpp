// SPDX-License-Identifier: MIT
// Bodies as particles in layers that conform to the surface. A voxelised round body has the wrong
// added mass (measured: -29 % acceleration; rings: -4 %), so round shapes get rings and shells.
#include "hyoryu/scene/fill.hpp"

#include "mesh_points.hpp"
#include "shape_points.hpp"

#include "hyoryu/scene/voxels.hpp"

namespace hyoryu {

namespace {

void add_place(Aggregate& body, const Vec3& point, bool on_surface)
{
    body.points.push_back(point);
    body.surface_points += on_surface ? 1 : 0;
}

void fill_shape(Aggregate& body, const auto& shape, double spacing, int dimensions)
{
    const ShapePoints points = shape_points(shape, spacing, dimensions);
    const Index number = number_of(points);
    for (Index k = 0; k < number; ++k) {
        const ShapePoint point = point_of(points, k);
        add_place(body, point.place, point.on_surface);
    }
}

void fill_shape(Aggregate& body, const MeshShape& mesh, double spacing, int)
{
    const TriangleTree tree = triangle_tree(mesh.corners, mesh.triangles);
    const Cells lattice = mesh_lattice(mesh, spacing);
    for (const MeshPoint& point : points_within(lattice, tree, {})) {
        add_place(body, point.place, point.nearest.distance > -spacing);
    }
    body.cell = lattice.edges();
}

void fill_shape(Aggregate& body, const ParticleShape& shape, double, int)
{
    body.points = shape.points;
    body.surface_points = exposed_cells(shape.points, Vec3::Constant(shape.spacing));
}

} // namespace

Aggregate aggregate(const Shape& shape, double spacing, int dimensions)
{
    Aggregate body;
    std::visit([&](const auto& s) { fill_shape(body, s, spacing, dimensions); }, shape);
    body.particle_volume = volume(shape, dimensions) / static_cast<double>(body.points.size());
    return body;
}

} // namespace hyoryu
