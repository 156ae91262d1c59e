// SPDX-License-Identifier: MIT
// The bodies and walls of a scene as the rigid-body system meets them.
#pragma once

#include "hyoryu/rigid/rigid.hpp"
#include "hyoryu/scene/scene.hpp"

namespace hyoryu {

/// Bodies in the order of the scene, boundaries in the order of its walls, laws of every pair of
/// materials. With the penalty method, the particles of bodies and obstacles as the filling places
/// them. Meshes meet others by their convex hull and have the exact mass properties of the
/// mesh.
Rigid make_rigid(const Scene& scene);

/// The density that gives the body the mass the user asked for [kg/m3].
double effective_density(const BodySettings& body, int dimensions);

} // namespace hyoryu
