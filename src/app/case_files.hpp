// SPDX-License-Identifier: MIT
// Whether files that a case names have changed.
#pragma once

#include "hyoryu/scene/case_difference.hpp"
#include "hyoryu/scene/scene.hpp"

#include <string>
#include <vector>

namespace hyoryu {

/// The keys of files whose contents the resolved case does not hold (terrain, meshes, particles),
/// and the hash of each, one a line; empty without such files. Series, footprints and polygons are
/// part of the resolved case. Throws IoError if a file cannot be read.
std::string hashes_of_files(const Scene& scene);

/// Files whose hashes differ between two texts of `hashes_of_files`; keys that only one of them has
/// are left out, since the cases themselves differ there.
std::vector<KeyDifference> file_differences(const std::string& before, const std::string& after);

} // namespace hyoryu
