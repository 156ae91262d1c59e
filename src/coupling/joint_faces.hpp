// SPDX-License-Identifier: MIT
// The flat faces of bodies, cut into cells: where joints may be.
#pragma once

#include "hyoryu/coupling/coupling.hpp"

#include <array>
#include <vector>

namespace hyoryu {

/// A cell of a face, in body axes. Its edges are numbered -u, +u, -v, +v; in two dimensions there
/// are the first two only.
struct JointCell {
    Vec3 centre{0, 0, 0}; // [m]
    double area = 0;      // [m2]; m in two dimensions
    int face = 0;
    std::array<int, 4> next{-1, -1, -1, -1}; // cell across each edge; -1: the rim of the face
    std::array<Vec3, 4> rim{};               // middle of each edge [m]
    std::array<int, 4> probe{};              // body particle that is nearest to each edge
    // Particles below the cell within the support of the kernel and no nearer to the opposite face,
    // in `BodyFaces::particles`: those of the outermost layer [first, inner), all [first, last).
    int first = 0, inner = 0, last = 0;
};

/// A flat face with its axes.
struct JointFace {
    Vec3 normal{0, 0, 1}, u{1, 0, 0}, v{0, 1, 0}; // outward; along the face
    double du = 0, dv = 1;                        // edges of a cell [m]
    int first = 0, last = 0;                      // cells
    Vec3 centre{0, 0, 0};                         // [m]
    double reach = 0;                             // largest distance of a corner from it [m]
};

/// All faces of one body.
struct BodyFaces {
    std::vector<JointFace> faces;
    std::vector<JointCell> cells;
    std::vector<int> particles; // counted from the first of the body
};

/// The planes that cut the cells.
struct JointScale {
    double spacing = 0;      // of the fluid [m]
    double body_spacing = 0; // of the body's particles [m]
    double support = 0;      // of the kernel [m]
    int dimensions = 3;
};

/// The flat faces of a shape that are wider than a spacing: sides of polytopes, caps of rods, sides
/// of the parts of a compound where no other part covers them. Cells are about a spacing wide, at
/// most 24 along a face, 64 in two dimensions. `points`: particles of the body.
BodyFaces joint_faces(const ContactShape& shape, std::span<const Vec3> points,
                      const JointScale& scale);

} // namespace hyoryu
