// SPDX-License-Identifier: MIT
// One frame as a VTKHDF 1.0 UnstructuredGrid: the oldest form that ParaView 5.10 and later opens.
#pragma once

#include "hyoryu/core/snapshot.hpp"

#include <filesystem>

namespace hyoryu {

/// Writes the file whole (temporary name, then renamed). Throws IoError.
void write_vtkhdf(const std::filesystem::path& file, const Cloud& cloud);
void write_vtkhdf(const std::filesystem::path& file, const Surface& surface);

} // namespace hyoryu
