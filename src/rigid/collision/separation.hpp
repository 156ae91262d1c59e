// SPDX-License-Identifier: MIT
// The signed distance of two convex solids along their best separating axis.
#pragma once

#include "feature.hpp"

namespace hyoryu {

/// Which features span the separating axis.
enum class AxisKind { face_of_a, face_of_b, edges };

/// The axis along which two convex solids are farthest apart, or overlap least.
struct Separation {
    double distance = -infinity; // [m], negative if they overlap
    AxisKind kind = AxisKind::face_of_a;
    int a = 0; // face or edge of a
    int b = 0; // face or edge of b
};

/// Whether the whole other solid lies above the face: then only the face can be nearest to it.
bool lies_over(const PlacedSolid& body, const PlacedSolid& under, int face);

/// Separating axes of two polytopes: the normals of all faces, and the cross products of those
/// edges that span a face of the Minkowski difference (Gregorius, GDC 2013). Returns early with the
/// first face axis that separates by more than `enough`. The tolerance between equivalent axes
/// scales with `unit`, as in RigidSettings.
Separation separation(const PlacedSolid& a, const PlacedSolid& b, double enough, double unit);

} // namespace hyoryu
