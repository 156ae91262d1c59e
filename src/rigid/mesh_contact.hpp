// SPDX-License-Identifier: MIT
// Bodies against a triangle surface. A triangle is looked at only while the middle of the convex
// part in question is in front of it: that side cannot be changed, and the far side of a thin
// mesh is never taken for the near one.
#pragma once

#include "narrow_phase.hpp"

namespace hyoryu {

/// Appends the features of a body and a mesh that face each other: corners over patches, creases
/// across edges, mesh corners under faces; for balls and rods their nearest points. Features of
/// polytopes are listed only where the two are near or overlap.
void find_mesh_candidates(const BodyPair& pair, const Configuration& at,
                          std::vector<Candidate>& found);

/// The distance of a body of polytopes from a mesh by separating axes [m]: negative if they
/// overlap, infinite if no triangle is within the bounding box of the body.
double mesh_distance(const BodyPair& pair, const Configuration& at);

/// The touch of the features that only meshes have.
Touch mesh_touch(const Feature& feature, const Configuration& at);

} // namespace hyoryu
