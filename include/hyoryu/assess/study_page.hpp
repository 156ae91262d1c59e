// SPDX-License-Identifier: MIT
// The results of a study, for people and for programs.
#pragma once

#include "hyoryu/assess/study_result.hpp"
#include "hyoryu/report/svg.hpp"
#include "hyoryu/report/table.hpp"

#include <string>
#include <vector>

namespace hyoryu {

/// The text under the title.
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
    TextTable table;
};
std::vector<StudyTable> study_tables(const StudyResult& result);

/// A picture for each quantity: the error against the work with the staircase of the best settings,
/// and against each number that is swept; more than three charts fill further files. Notes say
/// which could not be drawn.
struct StudyPictures {
    std::vector<SvgFile> files;
    std::vector<std::string> notes;
};
StudyPictures draw_study(const StudyResult& result);

/// The tables as a document beside the pictures, and as one page with the pictures inside it, which
/// needs neither network nor scripts.
std::string study_markdown(const StudyResult& result, const StudyInfo& info,
                           const std::vector<SvgFile>& pictures);
std::string study_page(const StudyResult& result, const StudyInfo& info,
                       const std::vector<SvgFile>& pictures);

} // namespace hyoryu
