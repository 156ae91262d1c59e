// SPDX-License-Identifier: MIT
// Separating axes of a convex polytope and the front of a triangle.
#pragma once

#include "feature.hpp"

namespace hyoryu {

/// A convex part of a body where it stands, in the axes of a mesh at time 0.
struct PartAt {
    const Solid& whole; // of the body
    const Solid& solid; // the part
    SolidPose pose;     // of the body
    std::vector<Vec3> corners;
    std::vector<Vec3> normals; // of the faces
    std::vector<double> offsets;
    Vec3 middle{0, 0, 0};
    AlignedBox box;
};

/// `shift`: the displacement of the mesh.
PartAt part_at(const Solid& whole, const Solid& part, const SolidPose& pose, const Vec3& shift);

/// The axis along which a part is farthest in front of a triangle, or overlaps it least.
struct TriangleAxis {
    enum class Kind { triangle, face, edges };
    double distance = -infinity; // [m], negative if they overlap
    Kind kind = Kind::triangle;
    int index = 0;  // of the face
    int corner = 0; // of the part, or 0 to 2 of the triangle for `face`: the deepest one
};

/// Infinite if the middle of the part is behind the triangle: meshes have one side. Returns early
/// with an axis that separates by more than `enough`. An axis that points behind the triangle, as
/// that of a contact on a crease sharper than a right angle may, separates but for a `touch`, and
/// is no way out of a deeper overlap.
TriangleAxis triangle_axis(const PartAt& part, const MeshTable& mesh, const FlatTriangle& triangle,
                           double enough, double touch);

/// Whether the part lies above the edge, seen along n, with a slack of the cosines for faces that
/// lie flat.
bool rests_on(const PartAt& part, const Edge& edge, const Vec3& n, double slack);

} // namespace hyoryu
