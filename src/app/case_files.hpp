// SPDX-License-Identifier: MIT
// Reading a case with all its mistakes, and whether files that it names have changed.
#pragma once

#include "hyoryu/scene/case_difference.hpp"
#include "hyoryu/scene/scene.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace hyoryu {

/// The same as `read_case`; mistakes in tables that place nothing are told together with those of
/// the filled scene, such as overlaps. Throws CaseError.
Scene read_whole_case(const std::filesystem::path& file, const std::vector<std::string>& overrides);

/// The keys of files whose contents the resolved case does not hold (terrain, meshes, particles),
/// and the hash of each, one a line; empty without such files. Series, footprints and polygons are
/// part of the resolved case. Throws IoError if a file cannot be read.
std::string hashes_of_files(const Scene& scene);

/// Files whose hashes differ between two texts of `hashes_of_files`; keys that only one of them has
/// are left out, since the cases themselves differ there.
std::vector<KeyDifference> file_differences(const std::string& before, const std::string& after);

} // namespace hyoryu
