// SPDX-License-Identifier: MIT
// Triangle meshes from STL and OBJ files, checked to be closed.
#pragma once

#include "hyoryu/core/types.hpp"

#include <array>
#include <filesystem>
#include <vector>

namespace hyoryu {

/// A triangle surface; triangles wind outwards.
struct Mesh {
    std::vector<Vec3> corners;                 // [m]
    std::vector<std::array<int, 3>> triangles; // corner numbers
};

/// Reads an STL (ASCII or binary) or OBJ file and merges coincident corners. Throws IoError with the
/// reason if the file is missing, unreadable, empty or of another kind, or if this build has no VTK.
Mesh read_mesh(const std::filesystem::path& file, double scale);

/// Why the mesh does not enclose a volume (open edges, edges of three triangles, zero volume); empty
/// if it does.
std::string closure_fault(const Mesh& mesh);

} // namespace hyoryu
