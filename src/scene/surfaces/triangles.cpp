// SPDX-License-Identifier: MIT
#include "hyoryu/scene/triangles.hpp"

#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

// Sides of a circle that looks round at the size of a picture.
constexpr int circle = 32;

// A planar convex polygon as a fan; its corners wind counter-clockwise from outside.
void add_polygon(TriangleSurface& surface, const std::vector<Vec3>& polygon)
{
    const int first = static_cast<int>(surface.corners.size());
    surface.corners.insert(surface.corners.end(), polygon.begin(), polygon.end());
    for (int k = 1; k + 1 < static_cast<int>(polygon.size()); ++k) {
        surface.triangles.push_back({first, first + k, first + k + 1});
    }
}

std::vector<Vec3> circle_points(double radius, const Vec3& centre, const Vec3& u, const Vec3& v)
{
    std::vector<Vec3> points;
    for (int k = 0; k < circle; ++k) {
        const double angle = 2 * std::numbers::pi * k / circle;
        points.push_back(centre + radius * (std::cos(angle) * u + std::sin(angle) * v));
    }
    return points;
}

// The face of the box [min, max] across `axis` at its lower (side 0) or upper (side 1) end, seen
// from outside the box.
std::vector<Vec3> face(const Vec3& min, const Vec3& max, int axis, int side)
{
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    Vec3 p = min;
    p[axis] = side == 0 ? min[axis] : max[axis];
    std::vector<Vec3> polygon(4, p);
    polygon[1][u] = max[u];
    polygon[2][u] = max[u];
    polygon[2][v] = max[v];
    polygon[3][v] = max[v];
    if (side == 0) {
        std::swap(polygon[1], polygon[3]);
    }
    return polygon;
}

void add(TriangleSurface& surface, const BoxShape& box, int dimensions)
{
    const Vec3 half = box.size / 2;
    if (dimensions == 2) {
        add_polygon(surface, {{-half.x(), 0, -half.z()},
                              {half.x(), 0, -half.z()},
                              {half.x(), 0, half.z()},
                              {-half.x(), 0, half.z()}});
        return;
    }
    for (int axis = 0; axis < 3; ++axis) {
        add_polygon(surface, face(-half, half, axis, 0));
        add_polygon(surface, face(-half, half, axis, 1));
    }
}

void add(TriangleSurface& surface, const SphereShape& sphere, int dimensions)
{
    if (dimensions == 2) {
        add_polygon(surface,
                    circle_points(sphere.radius, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitZ()));
        return;
    }
    constexpr int bands = circle / 2;
    const auto ring = [&](int band) {
        const double polar = std::numbers::pi * band / bands;
        return circle_points(sphere.radius * std::sin(polar),
                             {0, 0, -sphere.radius * std::cos(polar)}, Vec3::UnitX(),
                             Vec3::UnitY());
    };
    for (int band = 0; band < bands; ++band) {
        const auto low = ring(band);
        const auto high = ring(band + 1);
        for (std::size_t k = 0; k < low.size(); ++k) {
            const std::size_t next = (k + 1) % low.size();
            add_polygon(surface, {low[k], low[next], high[next], high[k]});
        }
    }
}

void add(TriangleSurface& surface, const CylinderShape& cylinder, int dimensions)
{
    if (dimensions == 2) {
        add(surface, BoxShape{{cylinder.length, 0, 2 * cylinder.radius}}, 2);
        return;
    }
    const Vec3 end{cylinder.length / 2, 0, 0};
    const auto right = circle_points(cylinder.radius, end, Vec3::UnitY(), Vec3::UnitZ());
    auto left = circle_points(cylinder.radius, -end, Vec3::UnitY(), Vec3::UnitZ());
    for (std::size_t k = 0; k < right.size(); ++k) {
        const std::size_t next = (k + 1) % right.size();
        add_polygon(surface, {left[k], left[next], right[next], right[k]});
    }
    add_polygon(surface, right);
    add_polygon(surface, {left.rbegin(), left.rend()});
}

void add(TriangleSurface& surface, const MeshShape& mesh, int)
{
    surface.corners = mesh.corners;
    surface.triangles = mesh.triangles;
}

// The faces of all boxes; those between two boxes are hidden.
void add(TriangleSurface& surface, const ParticleShape& shape, int)
{
    for (const auto& [low, high] : shape.boxes) {
        for (int axis = 0; axis < 3; ++axis) {
            add_polygon(surface, face(low, high, axis, 0));
            add_polygon(surface, face(low, high, axis, 1));
        }
    }
}

void add_wall(TriangleSurface& surface, const PlaneWall& plane, const Bounds& domain,
              int dimensions)
{
    const Vec3 centre = (domain.min + domain.max) / 2;
    const Vec3 foot = centre - plane.normal.dot(centre - plane.point) * plane.normal;
    const double reach = (domain.max - domain.min).norm() / 2;
    if (dimensions == 2) {
        const Vec3 t = Vec3::UnitY().cross(plane.normal);
        const Vec3 back = -0.02 * reach * plane.normal; // a strip: a line would not be seen
        add_polygon(surface, {foot - reach * t, foot + reach * t, foot + reach * t + back,
                              foot - reach * t + back});
        return;
    }
    // The rectangle that covers the domain's shadow on the plane, along the coordinate axes if it
    // can.
    const Vec3 helper = std::abs(plane.normal.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
    const Vec3 t = (helper - helper.dot(plane.normal) * plane.normal).normalized();
    const Vec3 s = plane.normal.cross(t);
    const Vec3 half = (domain.max - domain.min) / 2;
    const double along = half.dot(t.cwiseAbs());
    const double across = half.dot(s.cwiseAbs());
    add_polygon(surface, {foot - along * t - across * s, foot + along * t - across * s,
                          foot + along * t + across * s, foot - along * t + across * s});
}

void add_wall(TriangleSurface& surface, const BasinWall& basin, const Bounds&, int dimensions)
{
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 2; ++side) {
            if (basin.open[at(2 * axis + side)] || (dimensions == 2 && axis == 1)) {
                continue;
            }
            auto polygon = face(basin.min, basin.max, axis, side);
            if (dimensions == 2) {
                // A strip behind the edge of the section.
                const double thickness = 0.02 * (basin.max - basin.min).norm();
                Vec3 min = basin.min;
                Vec3 max = basin.max;
                (side == 0 ? max : min)[axis] = (side == 0 ? min : max)[axis];
                (side == 0 ? min : max)[axis] += side == 0 ? -thickness : thickness;
                polygon = {{min.x(), 0, min.z()},
                           {max.x(), 0, min.z()},
                           {max.x(), 0, max.z()},
                           {min.x(), 0, max.z()}};
            } else {
                std::swap(polygon[1], polygon[3]); // seen from inside
            }
            add_polygon(surface, polygon);
        }
    }
}

// The inside of a ball; in two dimensions a strip of sixty quadrangles behind the circle.
void add_wall(TriangleSurface& surface, const RoundWall& round, const Bounds&, int dimensions)
{
    if (dimensions == 3) {
        surface = triangles_of(SphereShape{round.radius}, 3);
        for (Vec3& corner : surface.corners) {
            corner += round.centre;
        }
        for (auto& triangle : surface.triangles) {
            std::swap(triangle[1], triangle[2]); // seen from inside
        }
        return;
    }
    constexpr int sides = 60;
    const auto at = [&](int k, double radius) {
        const double angle = 2 * std::numbers::pi * k / sides;
        return Vec3(round.centre + radius * Vec3(std::cos(angle), 0, std::sin(angle)));
    };
    const double outside = 1.04 * round.radius;
    for (int k = 0; k < sides; ++k) {
        add_polygon(surface, {at(k, round.radius), at(k, outside), at(k + 1, outside),
                              at(k + 1, round.radius)});
    }
}

void add_wall(TriangleSurface& surface, const SolidWall& solid, const Bounds&, int dimensions)
{
    surface = triangles_of(solid.shape, dimensions);
    for (Vec3& corner : surface.corners) {
        corner = solid.centre + solid.rotation * corner;
    }
}

} // namespace

TriangleSurface triangles_of(const Shape& shape, int dimensions)
{
    TriangleSurface surface;
    std::visit([&](const auto& s) { add(surface, s, dimensions); }, shape);
    return surface;
}

TriangleSurface triangles_of(const Wall& wall, const Bounds& domain, int dimensions)
{
    TriangleSurface surface;
    std::visit([&](const auto& g) { add_wall(surface, g, domain, dimensions); }, wall.geometry);
    return surface;
}

} // namespace hyoryu
