// SPDX-License-Identifier: MIT
#include "second_opinion.hpp"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>

namespace witness {

namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;
constexpr double deep = 1000; // of a prism, over its size

// The axis of FCL's cylinders is z.
Mat3 z_along(const Vec3& axis)
{
    return Quat::FromTwoVectors(Vec3::UnitZ(), axis).toRotationMatrix();
}

struct Shape {
    Geometry geometry;
    fcl::Transform3d pose = fcl::Transform3d::Identity(); // in the axes of the solid
};

Geometry convex_geometry(const Convex& part)
{
    const auto corners = std::make_shared<std::vector<Vec3>>(part.corners);
    const auto faces = std::make_shared<std::vector<int>>();
    for (const auto& t : part.faces) {
        faces->insert(faces->end(), {3, t[0], t[1], t[2]});
    }
    return std::make_shared<fcl::Convexd>(corners, static_cast<int>(part.faces.size()), faces);
}

Shape shape_of(const Convex& part, int dimensions)
{
    Shape shape;
    shape.pose.translation() = part.middle;
    if (part.cylinder_radius > 0) {
        shape.geometry =
            std::make_shared<fcl::Cylinderd>(part.cylinder_radius, 2 * part.half_length);
        shape.pose.linear() = z_along(Vec3::UnitX());
    } else if (part.corners.size() == 1 && dimensions == 2) {
        shape.geometry = std::make_shared<fcl::Cylinderd>(part.radius, deep * part.radius);
        shape.pose.linear() = z_along(Vec3::UnitY());
    } else if (part.corners.size() == 1) {
        shape.geometry = std::make_shared<fcl::Sphered>(part.radius);
    } else if (part.box.norm() > 0) {
        Vec3 size = part.box;
        size.y() = dimensions == 2 ? deep * part.reach : size.y();
        shape.geometry = std::make_shared<fcl::Boxd>(size);
    } else {
        shape.geometry = convex_geometry(part);
        shape.pose.translation().setZero();
    }
    return shape;
}

fcl::CollisionObjectd object_of(const Placed& placed, int dimensions)
{
    const Shape shape = shape_of(*placed.part, dimensions);
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.linear() = placed.turn;
    pose.translation() = placed.origin;
    return {shape.geometry, pose * shape.pose};
}

} // namespace

double depth_by_fcl(const Placed& a, const Placed& b, int dimensions)
{
    const fcl::CollisionObjectd one = object_of(a, dimensions);
    const fcl::CollisionObjectd other = object_of(b, dimensions);
    fcl::CollisionRequestd request(4, true);
    request.gjk_solver_type = fcl::GST_LIBCCD;
    fcl::CollisionResultd result;
    fcl::collide(&one, &other, request, result);
    double depth = 0;
    for (std::size_t k = 0; k < result.numContacts(); ++k) {
        depth = std::max(depth, std::abs(result.getContact(k).penetration_depth));
    }
    return depth;
}

struct BroadPhase::State {
    std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
    fcl::DynamicAABBTreeCollisionManagerd manager;
};

BroadPhase::BroadPhase(const std::vector<double>& radii) : state_(std::make_unique<State>())
{
    for (std::size_t k = 0; k < radii.size(); ++k) {
        auto object = std::make_unique<fcl::CollisionObjectd>(
            std::make_shared<fcl::Sphered>(radii[k]), fcl::Transform3d::Identity());
        object->setUserData(reinterpret_cast<void*>(k));
        state_->manager.registerObject(object.get());
        state_->objects.push_back(std::move(object));
    }
    state_->manager.setup();
}

BroadPhase::~BroadPhase() = default;

void BroadPhase::pairs(const std::vector<Vec3>& centres,
                       const std::function<void(std::size_t, std::size_t)>& visit)
{
    for (std::size_t k = 0; k < centres.size(); ++k) {
        state_->objects[k]->setTranslation(centres[k]);
        state_->objects[k]->computeAABB();
    }
    state_->manager.update();
    auto call = visit;
    const auto meet = [](fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
        const auto i = reinterpret_cast<std::size_t>(a->getUserData());
        const auto j = reinterpret_cast<std::size_t>(b->getUserData());
        (*static_cast<std::function<void(std::size_t, std::size_t)>*>(data))(std::min(i, j),
                                                                             std::max(i, j));
        return false; // go on
    };
    state_->manager.collide(&call, meet);
}

} // namespace witness
