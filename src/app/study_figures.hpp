// SPDX-License-Identifier: MIT
// The pictures of a study.
#pragma once

#include "hyoryu/assess/study_result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace hyoryu {

/// Draws one PNG for each quantity into the folder: the error against the work with the staircase
/// of the best settings, and against each number that is swept. Returns the names of the files;
/// notes say which could not be drawn.
struct StudyPictures {
    std::vector<std::string> files;
    std::vector<std::string> notes;
};
StudyPictures draw_study(const StudyResult& result, const std::filesystem::path& folder);

} // namespace hyoryu
