// SPDX-License-Identifier: MIT
#include "hyoryu/scene/rigid_scene.hpp"

#include "hyoryu/geometry/mesh.hpp"
#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/shapes.hpp"
#include "hyoryu/scene/voxels.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace hyoryu {

namespace {

// Index of each named material; 0 is that of everything without a name.
class Materials {
public:
    int index(const std::string& name)
    {
        return name.empty()
                   ? 0
                   : known_.try_emplace(name, static_cast<int>(known_.size()) + 1).first->second;
    }
    /// An index that no name has so far, one more than the largest.
    int another() const { return static_cast<int>(known_.size()) + 1; }

private:
    std::map<std::string, int> known_;
};

// A hull of more than this times the volume of the body does not represent it.
constexpr double convex_enough = 1.02;

ContactShape simple_shape(const Shape& shape, int dimensions)
{
    if (const auto* box = std::get_if<BoxShape>(&shape)) {
        return box_polytope(box->size, dimensions);
    }
    if (const auto* sphere = std::get_if<SphereShape>(&shape)) {
        return Ball{sphere->radius};
    }
    if (const auto* cylinder = std::get_if<CylinderShape>(&shape)) {
        if (dimensions == 2) {
            return box_polytope({cylinder->length, 0, 2 * cylinder->radius}, 2);
        }
        return Rod{cylinder->radius, cylinder->length};
    }
    return {};
}

Polytope polytope_of(const Vec3& low, const Vec3& high)
{
    Polytope box = box_polytope(high - low, 3);
    for (Vec3& corner : box.corners) {
        corner += (low + high) / 2;
    }
    return box;
}

ContactShape union_of(const std::vector<std::array<Vec3, 2>>& boxes)
{
    if (boxes.size() == 1) {
        return polytope_of(boxes[0][0], boxes[0][1]);
    }
    Compound compound;
    for (const auto& [low, high] : boxes) {
        compound.parts.push_back(polytope_of(low, high));
    }
    return compound;
}

ContactShape particle_shape(const ParticleShape& shape)
{
    ContactShape all = union_of(shape.boxes);
    if (shape.boxes.size() < shape.points.size() || shape.points.size() == 1) {
        return all;
    }
    std::vector<Vec3> corners;
    for (const Polytope& cube : std::get<Compound>(all).parts) {
        corners.insert(corners.end(), cube.corners.begin(), cube.corners.end());
    }
    Polytope hull = convex_hull(corners);
    const bool convex = mass_properties(hull, 1, 3).mass <= convex_enough * volume(shape, 3);
    return convex ? ContactShape(std::move(hull)) : std::move(all);
}

ContactShape mesh_shape(const MeshShape& mesh, double spacing)
{
    Polytope hull = convex_hull(mesh.corners);
    if (mass_properties(hull, 1, 3).mass <= convex_enough * volume(mesh, 3)) {
        return hull;
    }
    const Aggregate cells = aggregate(mesh, spacing, 3);
    std::vector<std::array<Vec3, 2>> boxes;
    const auto merged = merged_cells(cells.points, cells.cell);
    for (const Bounds& box : merged.value_or(std::vector<Bounds>{})) {
        boxes.push_back({box.min, box.max});
    }
    return union_of(boxes);
}

ContactShape shape_about_middle(const BodySettings& body, int dimensions)
{
    if (const auto* mesh = std::get_if<MeshShape>(&body.shape)) {
        return mesh_shape(*mesh, body.spacing);
    }
    if (const auto* particles = std::get_if<ParticleShape>(&body.shape)) {
        return particle_shape(*particles);
    }
    return simple_shape(body.shape, dimensions);
}

// Sum over the cubes about the mean, each with m d^2 / 6 about its own axes.
MassProperties mass_of_cubes(const ParticleShape& shape, double density)
{
    const double m = density * std::pow(shape.spacing, 3);
    Mat3 inertia = Mat3::Zero();
    for (const Vec3& r : shape.points) {
        inertia +=
            m * ((r.squaredNorm() + sq(shape.spacing) / 6) * Mat3::Identity() - r * r.transpose());
    }
    return {m * static_cast<double>(shape.points.size()), inertia};
}

// Copies of one body share their shape: filling a mesh is not cheap.
class ContactShapes {
public:
    const ContactShape& of(const BodySettings& body, int dimensions)
    {
        const bool known = last_ != nullptr && last_->place.line == body.place.line &&
                           body.place.line > 0 && last_->spacing == body.spacing;
        if (!known) {
            shape_ = contact_shape(body, dimensions);
            last_ = &body;
        }
        return shape_;
    }

private:
    const BodySettings* last_ = nullptr;
    ContactShape shape_;
};

MassProperties mass_of(const BodySettings& body, const ContactShape& contact, int dimensions)
{
    const double density = effective_density(body, dimensions);
    if (const auto* mesh = std::get_if<MeshShape>(&body.shape)) {
        const SolidProperties solid = solid_properties({mesh->corners, mesh->triangles});
        const Mat3& second = solid.second_moment;
        return {density * solid.volume, density * (second.trace() * Mat3::Identity() - second)};
    }
    if (const auto* particles = std::get_if<ParticleShape>(&body.shape)) {
        return mass_of_cubes(*particles, density);
    }
    return mass_properties(contact, density, dimensions);
}

// The inertia that the user gave, in two dimensions that about y.
void take_inertia(const BodySettings& settings, int dimensions, MassProperties& mass)
{
    if (settings.inertia && dimensions == 2) {
        mass.inertia(1, 1) = settings.inertia->y();
    } else if (settings.inertia) {
        mass.inertia = settings.inertia->asDiagonal();
    }
}

Body make_body(const BodySettings& settings, const ContactShape& shape, int dimensions,
               Materials& materials)
{
    Body body;
    body.name = settings.name;
    body.shape = shape;
    body.mass = mass_of(settings, body.shape, dimensions);
    take_inertia(settings, dimensions, body.mass);
    body.material = materials.index(settings.material);
    body.locks = settings.locks;
    if (settings.fixed) {
        body.locks.fill(true);
    }
    if (dimensions == 2) {
        body.locks[1] = body.locks[3] = body.locks[5] = true;
    }
    body.position = settings.position;
    body.orientation = settings.rotation;
    Vec3 omega = settings.angular_velocity;
    for (int axis = 0; axis < 3; ++axis) {
        body.velocity[axis] = body.locks[at(axis)] ? 0 : settings.velocity[axis];
        omega[axis] = body.locks[at(axis + 3)] ? 0 : omega[axis];
    }
    body.angular_momentum = angular_momentum(body, omega);
    return body;
}

Boundary make_boundary(const Wall& wall, const Scene& scene, Materials& materials)
{
    const int dimensions = scene.dimensions;
    Boundary boundary;
    boundary.name = wall.name;
    boundary.motion = wall.motion;
    boundary.material = materials.index(wall.material);
    if (const auto* plane = std::get_if<PlaneWall>(&wall.geometry)) {
        boundary.surface = Plane{plane->point, plane->normal};
    } else if (const auto* basin = std::get_if<BasinWall>(&wall.geometry)) {
        Basin inside{basin->min, basin->max, basin->open,
                     basin->thickness.value_or(thickness_of_rows(scene))};
        if (dimensions == 2) {
            inside.open[2] = inside.open[3] = true; // no walls across the section
        }
        boundary.surface = inside;
    } else if (const auto* round = std::get_if<RoundWall>(&wall.geometry)) {
        Basin box{round->centre - Vec3::Constant(round->radius),
                  round->centre + Vec3::Constant(round->radius),
                  {},
                  thickness_of_rows(scene)};
        box.open[2] = box.open[3] = dimensions == 2;
        boundary.surface = box;
    } else {
        const auto& solid = std::get<SolidWall>(wall.geometry);
        if (const auto* mesh = std::get_if<MeshShape>(&solid.shape)) {
            boundary.surface =
                MeshSurface{mesh->corners, mesh->triangles, solid.centre, solid.rotation};
        } else {
            boundary.surface =
                Obstacle{simple_shape(solid.shape, dimensions), solid.centre, solid.rotation};
        }
    }
    return boundary;
}

// The surface on which bodies stop at an open side: the window, as a block behind it that no body
// is thicker than.
Boundary make_stop(const OpenSettings& open, const Rigid& rigid, int material)
{
    const int dimensions = rigid.settings.dimensions;
    double thickness = 0;
    for (const Body& body : rigid.bodies) {
        thickness = std::max(thickness, 2 * bounding_radius(body, dimensions));
    }
    Vec3 size = open.max - open.min;
    size[open.axis()] = thickness;
    Vec3 centre = (open.min + open.max) / 2;
    centre[open.axis()] -= open.sign() * thickness / 2;
    return {.name = open.name,
            .surface = Obstacle{box_polytope(size, dimensions), centre},
            .material = material,
            .bodies_only = true};
}

// Neither rebound nor friction.
void add_stops(const Scene& scene, Materials& materials, Rigid& rigid)
{
    const auto stops = [](const OpenSettings& open) { return open.bodies == BodiesAtSide::stop; };
    if (rigid.bodies.empty() || rigid.penalty || std::ranges::none_of(scene.open, stops)) {
        return;
    }
    const int material = materials.another();
    for (int other = 0; other < material; ++other) {
        rigid.laws.pairs.push_back({{material, other}, {0, 0}});
    }
    for (const OpenSettings& open : scene.open) {
        if (stops(open)) {
            rigid.boundaries.push_back(make_stop(open, rigid, material));
        }
    }
}

// Particles of the bodies, and of the obstacles down to the depth that contact reaches.
Penalty make_penalty(const Scene& scene)
{
    constexpr double obstacle_layers = 2;
    Penalty penalty;
    penalty.parameters = *scene.contact.penalty;
    penalty.wall_spacing = scene.spacing;
    for (const BodySettings& body : scene.bodies) {
        std::vector<Vec3> points = aggregate(body.shape, body.spacing, scene.dimensions).points;
        move_to_middle(body, points);
        penalty.bodies.push_back(particle_cloud(std::move(points), body.spacing));
    }
    for (const Wall& wall : scene.walls) {
        std::vector<Vec3> points;
        if (const auto* solid = std::get_if<SolidWall>(&wall.geometry)) {
            const Placed own{.shape = &solid->shape, .dimensions = scene.dimensions};
            for (const Vec3& p : aggregate(solid->shape, scene.spacing, scene.dimensions).points) {
                if (signed_distance(own, p) > -obstacle_layers * scene.spacing) {
                    points.emplace_back(solid->centre + solid->rotation * p);
                }
            }
        }
        penalty.obstacles.push_back(particle_cloud(std::move(points), scene.spacing));
    }
    return penalty;
}

// Metres are used where possible: the round-off of positions, which grows with the distance from
// the origin, must stay below the tolerance lengths of the unit, and these well below the size of
// the bodies.
double unit_of_tolerances(const Rigid& rigid)
{
    constexpr double step = 1000;            // from unit to unit: mm, m, km
    const double half_way = std::sqrt(step); // 3 cm and 30 m, by ratio
    double smallest = infinity, farthest = 0;
    for (const Body& body : rigid.bodies) {
        const double reach = bounding_radius(body, rigid.settings.dimensions);
        smallest = std::min(smallest, reach);
        farthest = std::max(farthest, body.position.norm() + reach);
    }
    double unit = 1;
    while (smallest < infinity && smallest > half_way * unit) {
        unit *= step;
    }
    while (farthest > 0 && farthest < unit / half_way) {
        unit /= step;
    }
    return unit;
}

} // namespace

ContactShape contact_shape(const BodySettings& body, int dimensions)
{
    ContactShape shape = shape_about_middle(body, dimensions);
    return body.centre_of_mass ? moved(std::move(shape), middle_of_shape(body)) : shape;
}

double effective_density(const BodySettings& body, int dimensions)
{
    return body.mass > 0 ? body.mass / volume(body.shape, dimensions) : body.density;
}

Rigid make_rigid(const Scene& scene)
{
    Rigid rigid;
    rigid.settings.dimensions = scene.dimensions;
    rigid.settings.gravity = scene.gravity;
    rigid.settings.law = scene.contact.law;
    if (scene.contact.penalty) {
        rigid.penalty = make_penalty(scene);
    }
    Materials materials;
    ContactShapes shapes;
    for (const BodySettings& body : scene.bodies) {
        rigid.bodies.push_back(
            make_body(body, shapes.of(body, scene.dimensions), scene.dimensions, materials));
    }
    for (const Wall& wall : scene.walls) {
        rigid.boundaries.push_back(make_boundary(wall, scene, materials));
    }
    const double unit = unit_of_tolerances(rigid);
    rigid.settings.unit = unit;
    rigid.settings.contact_tolerance *= unit;
    rigid.settings.resting_speed *= std::sqrt(unit);
    rigid.laws.otherwise = {scene.contact.restitution, scene.contact.friction};
    for (const MaterialPair& pair : scene.contact.pairs) {
        rigid.laws.pairs.push_back(
            {{materials.index(pair.materials[0]), materials.index(pair.materials[1])},
             {pair.restitution, pair.friction}});
    }
    add_stops(scene, materials, rigid);
    return rigid;
}

} // namespace hyoryu
