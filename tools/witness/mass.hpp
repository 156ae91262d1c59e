// SPDX-License-Identifier: MIT
// Volume, mass and inertia from shape and density.
#pragma once

#include "scene.hpp"

namespace witness {

struct MassProperties {
    double mass = 0;             // [kg], kg/m in two dimensions
    Mat3 inertia = Mat3::Zero(); // about the centre of mass, body axes [kg m2]
};

/// Of a body. In two dimensions only the inertia about y has a meaning.
MassProperties mass_of(const Solid& body, int dimensions);

/// Centre of the volume that a mesh encloses [m].
Vec3 centroid(const Mesh& mesh);

/// The box about a mesh [m].
Eigen::AlignedBox3d bounds_of(const Mesh& mesh);

/// How often the surface winds about a point: 1 inside, 0 outside (solid angles of its triangles,
/// Van Oosterom and Strackee 1983).
double winding_number(const Mesh& mesh, const Vec3& point);

/// Distance from a point to the nearest triangle [m].
double distance_to(const Mesh& mesh, const Vec3& point);

} // namespace witness
