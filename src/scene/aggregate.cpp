// SPDX-License-Identifier: MIT
// Bodies as particles in layers that conform to the surface. A voxelised round body has the wrong
// added mass (measured: -29 % acceleration; rings: -4 %), so round shapes get rings and shells.
#include "hyoryu/scene/fill.hpp"

#include "mesh_points.hpp"

#include "hyoryu/scene/voxels.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

using std::numbers::pi;

bool outermost(Index k, Index n)
{
    return k == 0 || k == n - 1;
}

void place(Aggregate& body, const Vec3& point, bool on_surface)
{
    body.points.push_back(point);
    body.surface_points += on_surface ? 1 : 0;
}

void fill_shape(Aggregate& body, const BoxShape& box, double spacing, int dimensions)
{
    const Index nx = cells(box.size.x(), spacing);
    const Index ny = dimensions == 2 ? 1 : cells(box.size.y(), spacing);
    const Index nz = cells(box.size.z(), spacing);
    for (Index k = 0; k < nz; ++k) {
        for (Index j = 0; j < ny; ++j) {
            for (Index i = 0; i < nx; ++i) {
                const double y = dimensions == 2 ? 0 : middle(j, ny, box.size.y());
                const bool surface =
                    outermost(i, nx) || outermost(k, nz) || (dimensions == 3 && outermost(j, ny));
                place(body, {middle(i, nx, box.size.x()), y, middle(k, nz, box.size.z())}, surface);
            }
        }
    }
}

// Rings of a disc of radius R about the origin: calls put(u, v, layer) for each point, layer 0
// outside.
void rings(double radius, double spacing, const auto& put)
{
    const Index layers = cells(radius, spacing);
    const double step = radius / static_cast<double>(layers);
    for (Index layer = 0; layer < layers; ++layer) {
        const double r = radius - (static_cast<double>(layer) + 0.5) * step;
        const Index n = std::max<Index>(1, std::llround(2 * pi * r / spacing));
        // Alternate rings are turned by half a particle so that rows do not line up radially.
        const double phase = layer % 2 == 0 ? 0.0 : 0.5;
        for (Index k = 0; k < n; ++k) {
            const double angle = 2 * pi * (static_cast<double>(k) + phase) / static_cast<double>(n);
            put(r * std::cos(angle), r * std::sin(angle), layer);
        }
    }
}

void fill_shape(Aggregate& body, const SphereShape& sphere, double spacing, int dimensions)
{
    if (dimensions == 2) {
        rings(sphere.radius, spacing, [&](double u, double v, Index layer) {
            place(body, {u, 0, v}, layer == 0);
        });
        return;
    }
    const double golden = pi * (3 - std::sqrt(5.0));
    const Index layers = cells(sphere.radius, spacing);
    const double step = sphere.radius / static_cast<double>(layers);
    for (Index layer = 0; layer < layers; ++layer) {
        // A spiral of equal areas over the shell; the innermost shell may be a single point.
        const double r = sphere.radius - (static_cast<double>(layer) + 0.5) * step;
        const Index n = std::max<Index>(1, std::llround(4 * pi * sq(r) / sq(spacing)));
        for (Index k = 0; k < n; ++k) {
            const double z = n == 1 ? 0 : middle(k, n, 2.0);
            const double planar = std::sqrt(1 - sq(z));
            const double angle = golden * static_cast<double>(k);
            place(body, r * Vec3{planar * std::cos(angle), planar * std::sin(angle), z},
                  layer == 0);
        }
    }
}

void fill_shape(Aggregate& body, const CylinderShape& cylinder, double spacing, int dimensions)
{
    if (dimensions == 2) {
        fill_shape(body, BoxShape{{cylinder.length, 0, 2 * cylinder.radius}}, spacing, 2);
        return;
    }
    const Index nx = cells(cylinder.length, spacing);
    for (Index i = 0; i < nx; ++i) {
        rings(cylinder.radius, spacing, [&](double u, double v, Index layer) {
            place(body, {middle(i, nx, cylinder.length), u, v}, layer == 0 || outermost(i, nx));
        });
    }
}

void fill_shape(Aggregate& body, const MeshShape& mesh, double spacing, int)
{
    const TriangleTree tree = triangle_tree(mesh.corners, mesh.triangles);
    const MeshPoints found = points_within(mesh, tree, spacing, infinity);
    for (const MeshPoint& point : found.points) {
        place(body, point.place, point.nearest.distance > -spacing);
    }
    body.cell = found.cell;
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
