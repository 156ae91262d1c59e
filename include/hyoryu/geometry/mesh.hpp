// SPDX-License-Identifier: MIT
// Triangle meshes. They are read from STL and OBJ files by a reader that is loaded at run time, and
// checked: indices, finite corners, size, and whether the surface is closed and oriented.
#pragma once

#include "hyoryu/core/types.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace hyoryu {

/// A triangle surface; triangles wind outwards.
struct Mesh {
    std::vector<Vec3> corners;                 // [m]
    std::vector<std::array<int, 3>> triangles; // corner numbers
};

/// Reads an STL (ASCII or binary) or OBJ file and merges coincident corners; a surface that is
/// inside out is turned. Throws IoError with the reason if the file is missing, unreadable, empty
/// or of another kind, or if this build has no VTK.
Mesh read_mesh(const std::filesystem::path& file, double scale);

/// Why the mesh does not enclose a volume (open edges, edges of three triangles, triangles that
/// face the wrong way, zero volume); empty if it does.
std::string closure_fault(const Mesh& mesh);

/// The solid that a closed mesh encloses.
struct SolidProperties {
    double volume = 0;                 // [m3]
    Vec3 centroid{0, 0, 0};            // [m]
    Mat3 second_moment = Mat3::Zero(); // integral of x x^T about the centroid [m5]
};
SolidProperties solid_properties(const Mesh& mesh);

} // namespace hyoryu
