// SPDX-License-Identifier: MIT
// Contacts of bodies with a triangle surface. A triangle is tested only while the centre of the
// convex part is in front of it: a body cannot change the side, and the far side of a thin mesh is
// never mistaken for the near one.
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

/// The touch of the features that involve a crease or corner of a mesh.
Touch mesh_touch(const Feature& feature, const Configuration& at);

} // namespace hyoryu
