// SPDX-License-Identifier: MIT
// Conversion of the bodies and walls of a scene to the input of the rigid-body system.
#pragma once

#include "hyoryu/rigid/rigid.hpp"
#include "hyoryu/scene/scene.hpp"

namespace hyoryu {

/// Bodies in the order of the scene, boundaries in the order of its walls, laws of every pair of
/// materials. With the penalty method, the particles of bodies and obstacles as the filling places
/// them. Bodies have the exact mass properties of their shape, or those that the user gave. For
/// contact, bodies have the shape `contact_shape`, and a wall that is a mesh has the surface of the
/// mesh.
Rigid make_rigid(const Scene& scene);

/// The shape by which a body meets others, about its centre of mass: exact for boxes, spheres,
/// cylinders, convex meshes and particles on a lattice. A mesh whose hull has more than 1.02 times
/// its volume is the boxes of the cells that fill it at the spacing of its particles, a staircase;
/// particles on no lattice are their hull if it has not more than 1.02 times their volume, else a
/// cube each.
ContactShape contact_shape(const BodySettings& body, int dimensions);

/// The density that gives the body the mass the user asked for [kg/m3].
double effective_density(const BodySettings& body, int dimensions);

} // namespace hyoryu
