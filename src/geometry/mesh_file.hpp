// SPDX-License-Identifier: MIT
// The type of a mesh file, from its name and first bytes, checked before it is read.
#pragma once

#include <filesystem>

namespace hyoryu {

/// Triangles that a mesh may have; more is a mistake or an attack.
inline constexpr long long most_triangles = 5000000;
/// Coordinates beyond it are a mistake. Corners are merged within a part of the diagonal of the
/// mesh, so that one of them would make one corner of all others [m].
inline constexpr double farthest_corner = 1e8;

enum class MeshKind { stl_text, stl_binary, obj };

/// Throws IoError if the file is missing, unreadable, of another kind, or contradicts itself.
MeshKind mesh_kind(const std::filesystem::path& file);

} // namespace hyoryu
