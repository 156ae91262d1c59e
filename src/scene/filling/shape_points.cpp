// SPDX-License-Identifier: MIT
#include "shape_points.hpp"

#include "mesh_points.hpp"

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

// The number of the first point of each layer below a surface of `radius`; a layer at radius r has
// points_at(r) points. The last entry is the number of all points.
std::vector<Index> first_of_layers(double radius, double spacing, const auto& points_at)
{
    const Index count = cells(radius, spacing);
    const double step = radius / static_cast<double>(count);
    std::vector<Index> start{0};
    for (Index layer = 0; layer < count; ++layer) {
        const double r = radius - (static_cast<double>(layer) + 0.5) * step;
        start.push_back(start.back() + std::max<Index>(1, std::llround(points_at(r))));
    }
    return start;
}

// The radius of a layer and the place of a point in it.
struct InLayer {
    Index layer = 0;
    double radius = 0; // [m]
    Index k = 0, n = 0;
};

InLayer in_layer(const std::vector<Index>& start, double radius, Index point)
{
    const Index layer = std::ranges::upper_bound(start, point) - start.begin() - 1;
    const double step = radius / static_cast<double>(start.size() - 1);
    return {layer, radius - (static_cast<double>(layer) + 0.5) * step, point - start[at(layer)],
            start[at(layer + 1)] - start[at(layer)]};
}

RingPoints rings(double radius, double spacing, int dimensions)
{
    RingPoints points{.radius = radius, .dimensions = dimensions};
    points.start = first_of_layers(radius, spacing, [&](double r) { return 2 * pi * r / spacing; });
    return points;
}

} // namespace

ShapePoint BoxPoints::point(Index k) const
{
    const Index i = k % count[0];
    const Index j = k / count[0] % count[1];
    const Index l = k / count[0] / count[1];
    const double y = dimensions == 2 ? 0 : middle(j, count[1], size.y());
    const bool surface = outermost(i, count[0]) || outermost(l, count[2]) ||
                         (dimensions == 3 && outermost(j, count[1]));
    return {{middle(i, count[0], size.x()), y, middle(l, count[2], size.z())}, surface};
}

ShapePoint RingPoints::point(Index k) const
{
    const Index plane = k / start.back();
    const InLayer in = in_layer(start, radius, k % start.back());
    const double phase = in.layer % 2 == 0 ? 0.0 : 0.5;
    const double angle = 2 * pi * (static_cast<double>(in.k) + phase) / static_cast<double>(in.n);
    const double u = in.radius * std::cos(angle);
    const double v = in.radius * std::sin(angle);
    if (dimensions == 2) {
        return {{u, 0, v}, in.layer == 0};
    }
    return {{middle(plane, planes, length), u, v}, in.layer == 0 || outermost(plane, planes)};
}

ShapePoint ShellPoints::point(Index k) const
{
    const double golden = pi * (3 - std::sqrt(5.0));
    const InLayer in = in_layer(start, radius, k);
    // The innermost shell may be a single point.
    const double z = in.n == 1 ? 0 : middle(in.k, in.n, 2.0);
    const double planar = std::sqrt(1 - sq(z));
    const double angle = golden * static_cast<double>(in.k);
    return {in.radius * Vec3{planar * std::cos(angle), planar * std::sin(angle), z}, in.layer == 0};
}

ShapePoints shape_points(const BoxShape& box, double spacing, int dimensions)
{
    return BoxPoints{box.size,
                     {cells(box.size.x(), spacing),
                      dimensions == 2 ? 1 : cells(box.size.y(), spacing),
                      cells(box.size.z(), spacing)},
                     dimensions};
}

ShapePoints shape_points(const SphereShape& sphere, double spacing, int dimensions)
{
    if (dimensions == 2) {
        return rings(sphere.radius, spacing, dimensions);
    }
    ShellPoints points{.radius = sphere.radius, .start = {}};
    points.start = first_of_layers(sphere.radius, spacing,
                                   [&](double r) { return 4 * pi * sq(r) / sq(spacing); });
    return points;
}

ShapePoints shape_points(const CylinderShape& cylinder, double spacing, int dimensions)
{
    if (dimensions == 2) {
        return shape_points(BoxShape{{cylinder.length, 0, 2 * cylinder.radius}}, spacing, 2);
    }
    RingPoints points = rings(cylinder.radius, spacing, dimensions);
    points.length = cylinder.length;
    points.planes = cells(cylinder.length, spacing);
    return points;
}

Index number_of(const ShapePoints& points)
{
    return std::visit([](const auto& p) { return p.number(); }, points);
}

ShapePoint point_of(const ShapePoints& points, Index k)
{
    return std::visit([&](const auto& p) { return p.point(k); }, points);
}

} // namespace hyoryu
