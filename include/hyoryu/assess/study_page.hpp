// SPDX-License-Identifier: MIT
// What a study found, for people and for programs.
#pragma once

#include "hyoryu/assess/study_result.hpp"
#include "hyoryu/report/html.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace hyoryu {

/// What stands under the title.
struct StudyInfo {
    std::string version, commit, build;
    int threads = 0; // of each run
    int jobs = 1;    // runs side by side
};

/// One row for each quantity of each run: parameters, value, expected, error, cost, wall times.
std::string study_csv(const StudyResult& result);
std::string study_json(const StudyResult& result, const StudyInfo& info);

/// The tables of the study: runs by error and cost, orders and fits, cheapest settings.
struct StudyTable {
    std::string title;
    HtmlTable table;
};
std::vector<StudyTable> study_tables(const StudyResult& result);

/// The tables for a terminal or a document, and as one page with the pictures inside it, which
/// needs neither network nor scripts. Throws IoError if a picture cannot be read.
std::string study_markdown(const StudyResult& result, const StudyInfo& info,
                           const std::vector<std::string>& pictures);
std::string study_page(const StudyResult& result, const StudyInfo& info,
                       const std::vector<std::filesystem::path>& pictures);

} // namespace hyoryu
