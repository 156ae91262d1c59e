// SPDX-License-Identifier: MIT
#include "hyoryu/scene/solid_surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace hyoryu {

namespace {

// In two dimensions nothing has an end along y.
constexpr double without_end = 1e100;

Vec3 half_size(const Vec3& size, int dimensions)
{
    return {size.x() / 2, dimensions == 2 ? without_end : size.y() / 2, size.z() / 2};
}

// Unit vector along `v`, or `otherwise` where it has no direction.
Vec3 direction(const Vec3& v, const Vec3& otherwise)
{
    const double length = v.norm();
    return length > 0 ? Vec3(v / length) : otherwise;
}

NearestPlace nearest_to(const HalfSpace&, const Vec3& p, double)
{
    return {p.z(), Vec3::UnitZ()};
}

// Outside a box the Euclidean distance, inside that of the nearest face.
NearestPlace nearest_to(const Bounds& box, const Vec3& p)
{
    const Vec3 low = box.min - p;
    const Vec3 high = p - box.max;
    const Vec3 excess = low.cwiseMax(high);
    const Vec3 sign(low.x() > high.x() ? -1 : 1, low.y() > high.y() ? -1 : 1,
                    low.z() > high.z() ? -1 : 1);
    int axis = 0;
    const double most = excess.maxCoeff(&axis);
    if (most <= 0) {
        return {most, sign[axis] * Vec3::Unit(axis)};
    }
    const Vec3 out = excess.cwiseMax(0.0);
    const double distance = out.norm();
    return {distance, sign.cwiseProduct(out) / distance};
}

NearestPlace nearest_to(const SolidBox& box, const Vec3& p, double)
{
    return nearest_to(Bounds{-box.half, box.half}, p);
}

NearestPlace nearest_to(const SolidBall& ball, const Vec3& p, double)
{
    return {p.norm() - ball.radius, direction(p, Vec3::UnitZ())};
}

NearestPlace nearest_to(const HollowBall& ball, const Vec3& p, double)
{
    return {ball.radius - p.norm(), direction(-p, Vec3::UnitZ())};
}

NearestPlace nearest_to(const SolidRod& rod, const Vec3& p, double)
{
    const Vec3 radial = direction({0, p.y(), p.z()}, Vec3::UnitZ());
    const Vec3 axial = p.x() < 0 ? Vec3(-Vec3::UnitX()) : Vec3(Vec3::UnitX());
    const double out = std::hypot(p.y(), p.z()) - rod.radius;
    const double along = std::abs(p.x()) - rod.half_length;
    if (out > 0 && along > 0) {
        const double distance = std::hypot(out, along);
        return {distance, (out * radial + along * axial) / distance};
    }
    return out > along ? NearestPlace{out, radial} : NearestPlace{along, axial};
}

NearestPlace nearest_to(const HollowBox& basin, const Vec3& p, double)
{
    const Bounds& outer = basin.outer;
    if ((p.array() > outer.min.array()).all() && (p.array() < outer.max.array()).all()) {
        // In the cavity the nearest of its faces, in a side the nearest way out of it.
        const NearestPlace of_cavity = nearest_to(basin.cavity, p);
        const NearestPlace in{-of_cavity.distance, -of_cavity.normal};
        const NearestPlace out =
            of_cavity.distance > 0 ? nearest_to(outer, p) : NearestPlace{-infinity};
        return in.distance > out.distance ? in : out;
    }
    NearestPlace nearest;
    for (const Bounds& side : basin.sides) {
        const NearestPlace place = nearest_to(side, p);
        nearest = place.distance < nearest.distance ? place : nearest;
    }
    return nearest;
}

NearestPlace nearest_to(const TriangleTree& tree, const Vec3& p, double farthest)
{
    return nearest_place(tree, p, farthest);
}

HollowBox hollow_box(const BasinWall& basin, double thickness, int dimensions)
{
    HollowBox hollow;
    hollow.cavity = {basin.min, basin.max};
    hollow.outer = hollow.cavity;
    for (int a = 0; a < 3; ++a) {
        const auto k = at(a);
        const bool none = dimensions == 2 && a == 1;
        const bool low_open = basin.open[2 * k] || none;
        const bool high_open = basin.open[2 * k + 1] || none;
        hollow.cavity.min[a] = low_open ? -without_end : basin.min[a];
        hollow.cavity.max[a] = high_open ? without_end : basin.max[a];
        hollow.outer.min[a] = none ? -without_end : basin.min[a] - (low_open ? 0 : thickness);
        hollow.outer.max[a] = none ? without_end : basin.max[a] + (high_open ? 0 : thickness);
    }
    for (int a = 0; a < 3; ++a) {
        for (const bool low : {true, false}) {
            Bounds side = hollow.outer;
            (low ? side.max : side.min)[a] = (low ? hollow.cavity.min : hollow.cavity.max)[a];
            if (side.min[a] < side.max[a]) { // not an open one
                hollow.sides.push_back(side);
            }
        }
    }
    return hollow;
}

// The squares of the cubes that no other cube covers, as triangles.
TriangleTree cubes_of(const ParticleShape& shape)
{
    using Square = std::array<long long, 4>; // the axis across it, twice its middle
    const Vec3 first = shape.points.empty() ? Vec3(0, 0, 0) : shape.points.front();
    std::map<Square, std::pair<int, Vec3>> squares; // how many, of which point and side
    constexpr double fine = 1 << 16;                // of an edge: nearer points are merged
    for (const Vec3& p : shape.points) {
        for (int a = 0; a < 3; ++a) {
            for (const double side : {-0.5, 0.5}) {
                const Vec3 middle = p + side * shape.spacing * Vec3::Unit(a);
                const Vec3 place = (fine / shape.spacing) * (middle - first);
                const Square key{a, std::llround(place.x()), std::llround(place.y()),
                                 std::llround(place.z())};
                auto& found = squares.try_emplace(key, 0, Vec3::Zero()).first->second;
                found.first += 1;
                found.second = 2 * side * Vec3::Unit(a) + Vec3::Zero();
            }
        }
    }
    std::vector<Vec3> corners;
    std::vector<std::array<int, 3>> triangles;
    for (const auto& [key, square] : squares) {
        if (square.first > 1) {
            continue;
        }
        const int a = static_cast<int>(key[0]);
        const Vec3 middle =
            first + shape.spacing / fine *
                        Vec3(static_cast<double>(key[1]), static_cast<double>(key[2]),
                             static_cast<double>(key[3]));
        const Vec3 u = 0.5 * shape.spacing * Vec3::Unit((a + 1) % 3);
        const Vec3 v = square.second[a] * 0.5 * shape.spacing * Vec3::Unit((a + 2) % 3);
        const int at = static_cast<int>(corners.size());
        for (const Vec3& corner : {Vec3(-u - v), Vec3(u - v), Vec3(u + v), Vec3(-u + v)}) {
            corners.emplace_back(middle + corner);
        }
        triangles.push_back({at, at + 1, at + 2});
        triangles.push_back({at, at + 2, at + 3});
    }
    return triangle_tree(corners, triangles);
}

void set_shape(SolidSurface& surface, const Shape& shape, int dimensions)
{
    if (const auto* box = std::get_if<BoxShape>(&shape)) {
        surface.shape = SolidBox{half_size(box->size, dimensions)};
    } else if (const auto* sphere = std::get_if<SphereShape>(&shape)) {
        surface.shape = SolidBall{sphere->radius};
    } else if (const auto* cylinder = std::get_if<CylinderShape>(&shape)) {
        if (dimensions == 2) {
            surface.shape =
                SolidBox{half_size({cylinder->length, 0, 2 * cylinder->radius}, dimensions)};
        } else {
            surface.shape = SolidRod{cylinder->radius, cylinder->length / 2};
        }
    } else if (const auto* mesh = std::get_if<MeshShape>(&shape)) {
        surface.shape = triangle_tree(mesh->corners, mesh->triangles);
    } else {
        surface.shape = cubes_of(std::get<ParticleShape>(shape));
    }
    const Bounds own = bounds({.shape = &shape, .dimensions = dimensions});
    surface.reach = own.min.cwiseAbs().cwiseMax(own.max.cwiseAbs()).norm();
}

} // namespace

SolidSurface surface_of(const Wall& wall, double thickness, int dimensions)
{
    SolidSurface surface;
    if (const auto* plane = std::get_if<PlaneWall>(&wall.geometry)) {
        surface.centre = plane->point;
        surface.rotation = Quat::FromTwoVectors(Vec3::UnitZ(), plane->normal);
    } else if (const auto* basin = std::get_if<BasinWall>(&wall.geometry)) {
        surface.shape = hollow_box(*basin, thickness, dimensions);
    } else if (const auto* round = std::get_if<RoundWall>(&wall.geometry)) {
        surface.shape = HollowBall{round->radius};
        surface.centre = round->centre;
    } else {
        const auto& solid = std::get<SolidWall>(wall.geometry);
        set_shape(surface, solid.shape, dimensions);
        surface.centre = solid.centre;
        surface.rotation = solid.rotation;
    }
    return surface;
}

std::vector<SolidSurface> surfaces_of(const std::vector<Wall>& walls, double thickness,
                                      int dimensions)
{
    std::vector<SolidSurface> surfaces;
    for (const Wall& wall : walls) {
        surfaces.push_back(surface_of(wall, thickness, dimensions));
    }
    return surfaces;
}

SolidSurface surface_of(const BodySettings& body, int dimensions)
{
    SolidSurface surface;
    set_shape(surface, body.shape, dimensions);
    surface.centre = body.position;
    surface.rotation = body.rotation;
    surface.middle = middle_of_shape(body);
    surface.reach += surface.middle.norm();
    return surface;
}

NearestPlace nearest_place(const SolidSurface& solid, const Vec3& point, double farthest)
{
    const Vec3 p = point - solid.middle;
    NearestPlace nearest =
        std::visit([&](const auto& s) { return nearest_to(s, p, farthest); }, solid.shape);
    return nearest.distance <= farthest ? nearest : NearestPlace{};
}

NearestPlace nearest_from_centre(const SolidSurface& solid, const Vec3& way, double farthest)
{
    NearestPlace nearest = nearest_place(solid, solid.rotation.conjugate() * way, farthest);
    nearest.normal = solid.rotation * nearest.normal;
    return nearest;
}

} // namespace hyoryu
