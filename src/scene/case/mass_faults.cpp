// SPDX-License-Identifier: MIT
#include "hyoryu/scene/mass_faults.hpp"

#include "hyoryu/rigid/body.hpp"
#include "hyoryu/scene/shapes.hpp"

#include <fmt/format.h>

namespace hyoryu {

namespace {

// Rounding of the numbers in a file.
constexpr double rounding = 1e-9;

// Distance of a point outside the convex hull of points, from the faces of the hull.
double outside_hull(const std::vector<Vec3>& points, const Vec3& p)
{
    const Polytope hull = convex_hull(points);
    double out = -infinity;
    for (const std::vector<int>& face : hull.faces) {
        const auto corner = [&](std::size_t k) { return hull.corners[at(face[k])]; };
        Vec3 normal = Vec3::Zero();
        for (std::size_t k = 2; k < face.size(); ++k) {
            normal += (corner(k - 1) - corner(0)).cross(corner(k) - corner(0));
        }
        out = std::max(out, normal.normalized().dot(p - corner(0)));
    }
    return out;
}

double outside_hull(const Shape& shape, const Vec3& p, int dimensions)
{
    if (const auto* mesh = std::get_if<MeshShape>(&shape)) {
        return outside_hull(mesh->corners, p);
    }
    if (const auto* particles = std::get_if<ParticleShape>(&shape)) {
        std::vector<Vec3> corners;
        for (const auto& [low, high] : particles->boxes) {
            for (const Vec3& corner : box_polytope(high - low, 3).corners) {
                corners.push_back((low + high) / 2 + corner);
            }
        }
        return outside_hull(corners, p);
    }
    return signed_distance({.shape = &shape, .dimensions = dimensions}, p);
}

// Distance from the centre of mass to the farthest corner of the box about the shape.
double farthest(const BodySettings& body, int dimensions)
{
    const Bounds box = bounds({.shape = &body.shape, .dimensions = dimensions});
    const Vec3 centre = -middle_of_shape(body);
    Vec3 way = (centre - box.min).cwiseAbs().cwiseMax((box.max - centre).cwiseAbs());
    if (dimensions == 2) {
        way.y() = 0;
    }
    return way.norm();
}

} // namespace

std::string centre_fault(const BodySettings& body, int dimensions)
{
    if (!body.centre_of_mass || !(volume(body.shape, dimensions) > 0)) {
        return {};
    }
    const double out = outside_hull(body.shape, *body.centre_of_mass, dimensions);
    const Bounds box = bounds({.shape = &body.shape, .dimensions = dimensions});
    if (!(out > rounding * (box.max - box.min).norm())) {
        return {};
    }
    return fmt::format("lies {:.3g} m outside the shape, expected a point within its hull", out);
}

std::string inertia_fault(const BodySettings& body, int dimensions)
{
    if (!body.inertia) {
        return {};
    }
    const Vec3& I = *body.inertia;
    for (const int axis : {0, 1, 2}) {
        if (dimensions == 2 && axis != 1) {
            continue;
        }
        const char name = "xyz"[axis];
        if (!(I[axis] > 0)) {
            return fmt::format("I{0}{0} is {1:.6g} kg m2, expected > 0 kg m2", name, I[axis]);
        }
        const double others = I.sum() - I[axis];
        if (dimensions == 3 && I[axis] > others * (1 + rounding)) {
            return fmt::format("I{0}{0} = {1:.6g} kg m2 exceeds the sum of the other two, {2:.6g} "
                               "kg m2, which is impossible for a rigid body",
                               name, I[axis], others);
        }
        // A pole has 4e-4 of `most` about its axis. Below the limit, contact would turn the body
        // about in every step.
        constexpr double least_share = 1e-4;
        const double most = body.mass * sq(farthest(body, dimensions));
        if (I[axis] < least_share * most) {
            return fmt::format("I{0}{0} = {1:.6g} kg m2 is below {2:.6g} kg m2 = 1e-4 M r^2, with "
                               "the mass M and the "
                               "distance r to the farthest point of the shape",
                               name, I[axis], least_share * most);
        }
        if (most > 0 && I[axis] > most * (1 + rounding)) {
            return fmt::format(
                "I{0}{0} = {1:.6g} kg m2 exceeds {2:.6g} kg m2 = M r^2, with the mass M and "
                "the distance r to the farthest point of the shape",
                name, I[axis], most);
        }
    }
    return {};
}

std::string extent_fault(const BodySettings& body, int dimensions)
{
    constexpr double least = 1e-6; // [m]
    const Bounds box = bounds({.shape = &body.shape, .dimensions = dimensions});
    Vec3 size = box.max - box.min;
    if (dimensions == 2) {
        size.y() = infinity;
    }
    if (box.empty() || size.minCoeff() >= least) {
        return {};
    }
    return fmt::format("is {:.3g} m thick, expected at least {:g} m", size.minCoeff(), least);
}

} // namespace hyoryu
