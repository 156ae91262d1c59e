// SPDX-License-Identifier: MIT
#include "hyoryu/scene/shapes.hpp"

#include "conform.hpp"

#include "hyoryu/geometry/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

// Distance to a box of half edges `half`; coordinates with half = infinity do not count.
double box_distance(const Vec3& p, const Vec3& half)
{
    const Vec3 excess = p.cwiseAbs() - half;
    return excess.cwiseMax(0.0).norm() + std::min(excess.maxCoeff(), 0.0);
}

double distance_to(const BoxShape& box, Vec3 p, int dimensions)
{
    Vec3 half = box.size / 2;
    if (dimensions == 2) {
        half.y() = 1e300;
        p.y() = 0;
    }
    return box_distance(p, half);
}

double distance_to(const SphereShape& sphere, const Vec3& p, int)
{
    return p.norm() - sphere.radius;
}

double distance_to(const CylinderShape& cylinder, const Vec3& p, int dimensions)
{
    const double radial = dimensions == 2 ? std::abs(p.z()) : std::hypot(p.y(), p.z());
    const double out_radial = radial - cylinder.radius;
    const double out_axial = std::abs(p.x()) - cylinder.length / 2;
    return std::hypot(std::max(out_radial, 0.0), std::max(out_axial, 0.0)) +
           std::min(std::max(out_radial, out_axial), 0.0);
}

// Closest point of a triangle (Ericson 2005, sec. 5.1.5).
Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c)
{
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const Vec3 ap = p - a;
    const double d1 = ab.dot(ap);
    const double d2 = ac.dot(ap);
    if (d1 <= 0 && d2 <= 0) {
        return a;
    }
    const Vec3 bp = p - b;
    const double d3 = ab.dot(bp);
    const double d4 = ac.dot(bp);
    if (d3 >= 0 && d4 <= d3) {
        return b;
    }
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        return a + d1 / (d1 - d3) * ab;
    }
    const Vec3 cp = p - c;
    const double d5 = ab.dot(cp);
    const double d6 = ac.dot(cp);
    if (d6 >= 0 && d5 <= d6) {
        return c;
    }
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        return a + d2 / (d2 - d6) * ac;
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
    }
    const double scale = 1 / (va + vb + vc);
    return a + ab * (vb * scale) + ac * (vc * scale);
}

// Solid angle of a triangle seen from p over 4 pi (van Oosterom & Strackee 1983): sums to the
// winding number, 1 inside and 0 outside of a closed surface.
double winding(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c)
{
    const Vec3 ra = a - p;
    const Vec3 rb = b - p;
    const Vec3 rc = c - p;
    const double la = ra.norm();
    const double lb = rb.norm();
    const double lc = rc.norm();
    const double det = ra.dot(rb.cross(rc));
    const double den = la * lb * lc + ra.dot(rb) * lc + rb.dot(rc) * la + rc.dot(ra) * lb;
    return std::atan2(det, den) / (2 * std::numbers::pi);
}

double distance_to(const MeshShape& mesh, const Vec3& p, int)
{
    double nearest = infinity;
    double turns = 0;
    for (const auto& t : mesh.triangles) {
        const Vec3& a = mesh.corners[at(t[0])];
        const Vec3& b = mesh.corners[at(t[1])];
        const Vec3& c = mesh.corners[at(t[2])];
        nearest = std::min(nearest, (p - closest_on_triangle(p, a, b, c)).squaredNorm());
        turns += winding(p, a, b, c);
    }
    return std::sqrt(nearest) * (turns > 0.5 ? -1 : 1);
}

double distance_to(const ParticleShape& shape, const Vec3& p, int)
{
    double nearest = infinity;
    for (const auto& [low, high] : shape.boxes) {
        nearest = std::min(nearest, box_distance(p - (low + high) / 2, (high - low) / 2));
    }
    return nearest;
}

// Corners of the box that bounds the shape in its own axes.
Bounds own_bounds(const Shape& shape)
{
    Bounds box;
    if (const auto* b = std::get_if<BoxShape>(&shape)) {
        box.add(Bounds{-b->size / 2, b->size / 2});
    } else if (const auto* s = std::get_if<SphereShape>(&shape)) {
        box.add(Bounds{Vec3::Constant(-s->radius), Vec3::Constant(s->radius)});
    } else if (const auto* c = std::get_if<CylinderShape>(&shape)) {
        const Vec3 half{c->length / 2, c->radius, c->radius};
        box.add(Bounds{-half, half});
    } else if (const auto* mesh = std::get_if<MeshShape>(&shape)) {
        for (const Vec3& corner : mesh->corners) {
            box.add(corner);
        }
    } else {
        for (const auto& [low, high] : std::get<ParticleShape>(shape).boxes) {
            box.add(Bounds{low, high});
        }
    }
    return box;
}

double volume_of(const BoxShape& b, int dimensions)
{
    return dimensions == 2 ? b.size.x() * b.size.z() : b.size.prod();
}
double volume_of(const SphereShape& s, int dimensions)
{
    using std::numbers::pi;
    return dimensions == 2 ? pi * sq(s.radius) : 4.0 / 3.0 * pi * s.radius * sq(s.radius);
}
double volume_of(const CylinderShape& c, int dimensions)
{
    return dimensions == 2 ? 2 * c.radius * c.length : std::numbers::pi * sq(c.radius) * c.length;
}
double volume_of(const MeshShape& mesh, int)
{
    return solid_properties({mesh.corners, mesh.triangles}).volume;
}

double volume_of(const ParticleShape& shape, int)
{
    return static_cast<double>(shape.points.size()) * std::pow(shape.spacing, 3);
}

} // namespace

Vec3 closest_on_triangle(const MeshShape& mesh, const std::array<int, 3>& triangle,
                         const Vec3& point)
{
    return closest_on_triangle(point, mesh.corners[at(triangle[0])], mesh.corners[at(triangle[1])],
                               mesh.corners[at(triangle[2])]);
}

Vec3 middle_of_shape(const BodySettings& body)
{
    return body.centre_of_mass ? Vec3(-*body.centre_of_mass) : Vec3(Vec3::Zero());
}

void move_to_middle(const BodySettings& body, std::vector<Vec3>& points)
{
    if (body.centre_of_mass) {
        for (Vec3& point : points) {
            point -= *body.centre_of_mass;
        }
    }
}

Placed placed(const BodySettings& body, int dimensions)
{
    const Vec3 middle = body.centre_of_mass
                            ? Vec3(body.position - body.rotation * *body.centre_of_mass)
                            : body.position;
    return {&body.shape, middle, body.rotation, dimensions};
}

Placed placed(const FluidBlock& block, int dimensions)
{
    return {&block.shape, block.centre, block.rotation, dimensions};
}

Placed placed(const SolidWall& solid, int dimensions)
{
    return {&solid.shape, solid.centre, solid.rotation, dimensions};
}

double volume(const Shape& shape, int dimensions)
{
    return std::visit([&](const auto& s) { return volume_of(s, dimensions); }, shape);
}

double signed_distance(const Placed& placed, const Vec3& point)
{
    Vec3 offset = point - placed.centre;
    if (placed.dimensions == 2) {
        offset.y() = 0;
    }
    const Vec3 p = placed.rotation.conjugate() * offset;
    return std::visit([&](const auto& s) { return distance_to(s, p, placed.dimensions); },
                      *placed.shape);
}

Bounds bounds(const Placed& placed)
{
    const Bounds own = own_bounds(*placed.shape);
    if (std::holds_alternative<SphereShape>(*placed.shape)) {
        return {own.min + placed.centre, own.max + placed.centre};
    }
    Bounds box;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p{(corner & 1) != 0 ? own.max.x() : own.min.x(),
                     (corner & 2) != 0 ? own.max.y() : own.min.y(),
                     (corner & 4) != 0 ? own.max.z() : own.min.z()};
        box.add(placed.centre + placed.rotation * p);
    }
    if (placed.dimensions == 2) {
        box.min.y() = 0;
        box.max.y() = 0;
    }
    return box;
}

Bounds bounds(const Wall& wall, int dimensions)
{
    if (const auto* basin = std::get_if<BasinWall>(&wall.geometry)) {
        return {basin->min, basin->max};
    }
    if (const auto* round = std::get_if<RoundWall>(&wall.geometry)) {
        return {round->centre - Vec3::Constant(round->radius),
                round->centre + Vec3::Constant(round->radius)};
    }
    const auto* solid = std::get_if<SolidWall>(&wall.geometry);
    return solid != nullptr ? bounds(placed(*solid, dimensions)) : Bounds{};
}

namespace {

// The box of a wall over its whole motion: a path does not overshoot its points.
Bounds swept(const Bounds& box, const Motion& motion, double end)
{
    Bounds all = box;
    const auto add = [&](const Vec3& d) { all.add(Bounds{box.min + d, box.max + d}); };
    add(displacement(motion, end));
    for (std::size_t k = 0; k < motion.times.size(); ++k) {
        if (motion.times[k] < end) {
            add(motion.places[k]);
        }
    }
    return all;
}

} // namespace

Bounds domain_of(const Scene& scene)
{
    if (scene.domain) {
        return {scene.domain->min, scene.domain->max};
    }
    Bounds box;
    if (scene.fluid) {
        for (const FluidBlock& block : scene.fluid->blocks) {
            box.add(bounds(placed(block, scene.dimensions)));
        }
    }
    for (const BodySettings& body : scene.bodies) {
        box.add(bounds(placed(body, scene.dimensions)));
    }
    for (const Wall& wall : scene.walls) {
        if (const Bounds own = bounds(wall, scene.dimensions); !own.empty()) {
            box.add(swept(own, wall.motion, scene.time.end));
        }
    }
    if (box.empty()) {
        box.add(Vec3::Zero());
    }
    for (const Wall& wall : scene.walls) {
        if (const auto* plane = std::get_if<PlaneWall>(&wall.geometry)) {
            // The foot of the scene's middle on the plane: the plane itself has no bounds.
            const Vec3 middle = (box.min + box.max) / 2;
            box.add(Vec3(middle - plane->normal.dot(middle - plane->point) * plane->normal));
        }
    }
    const double headroom = (box.max - box.min).maxCoeff() / 2 + scene.spacing;
    box.max.z() += headroom;
    if (scene.dimensions == 2) {
        box.min.y() = 0;
        box.max.y() = 0;
    }
    return box;
}

} // namespace hyoryu
