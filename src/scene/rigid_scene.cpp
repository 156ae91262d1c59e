// SPDX-License-Identifier: MIT
#include "hyoryu/scene/rigid_scene.hpp"

#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/shapes.hpp"

#include <algorithm>
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

private:
    std::map<std::string, int> known_;
};

ContactShape contact_shape(const Shape& shape, int dimensions)
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
    return convex_hull(std::get<MeshShape>(shape).corners);
}

MassProperties mass_of(const BodySettings& body, const ContactShape& contact, int dimensions)
{
    const double density = effective_density(body, dimensions);
    if (const auto* mesh = std::get_if<MeshShape>(&body.shape)) {
        Polytope surface{mesh->corners, {}};
        for (const auto& t : mesh->triangles) {
            surface.faces.push_back({t[0], t[1], t[2]});
        }
        return mass_properties(surface, density, dimensions);
    }
    return mass_properties(contact, density, dimensions);
}

Body make_body(const BodySettings& settings, int dimensions, Materials& materials)
{
    Body body;
    body.name = settings.name;
    body.shape = contact_shape(settings.shape, dimensions);
    body.mass = mass_of(settings, body.shape, dimensions);
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
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        body.velocity[axis] = body.locks[k] ? 0 : settings.velocity[axis];
    }
    Vec3 omega = settings.angular_velocity;
    for (int axis = 0; axis < 3; ++axis) {
        omega[axis] = body.locks[static_cast<std::size_t>(axis) + 3] ? 0 : omega[axis];
    }
    body.angular_momentum = angular_momentum(body, omega);
    return body;
}

Boundary make_boundary(const Wall& wall, int dimensions, Materials& materials)
{
    Boundary boundary;
    boundary.name = wall.name;
    boundary.motion.velocity = wall.velocity;
    boundary.material = materials.index(wall.material);
    if (const auto* plane = std::get_if<PlaneWall>(&wall.geometry)) {
        boundary.surface = Plane{plane->point, plane->normal};
    } else if (const auto* basin = std::get_if<BasinWall>(&wall.geometry)) {
        Basin inside{basin->min, basin->max, basin->open};
        if (dimensions == 2) {
            inside.open[2] = inside.open[3] = true; // no walls across the section
        }
        boundary.surface = inside;
    } else {
        const auto& solid = std::get<SolidWall>(wall.geometry);
        boundary.surface =
            Obstacle{contact_shape(solid.shape, dimensions), solid.centre, solid.rotation};
    }
    return boundary;
}

// Particles of the bodies, and of the obstacles down to the depth that contact reaches.
Penalty make_penalty(const Scene& scene)
{
    constexpr double obstacle_layers = 2;
    Penalty penalty;
    penalty.parameters = *scene.contact.penalty;
    penalty.wall_spacing = scene.spacing;
    for (const BodySettings& body : scene.bodies) {
        penalty.bodies.push_back(particle_cloud(
            aggregate(body.shape, body.spacing, scene.dimensions).points, body.spacing));
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

} // namespace

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
    for (const BodySettings& body : scene.bodies) {
        rigid.bodies.push_back(make_body(body, scene.dimensions, materials));
    }
    for (const Wall& wall : scene.walls) {
        rigid.boundaries.push_back(make_boundary(wall, scene.dimensions, materials));
    }
    rigid.laws.otherwise = {scene.contact.restitution, scene.contact.friction};
    for (const MaterialPair& pair : scene.contact.pairs) {
        rigid.laws.pairs.push_back(
            {{materials.index(pair.materials[0]), materials.index(pair.materials[1])},
             {pair.restitution, pair.friction}});
    }
    return rigid;
}

} // namespace hyoryu
