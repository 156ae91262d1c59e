// SPDX-License-Identifier: MIT
// The runs of a study as processes of this program.
#pragma once

#include "hyoryu/assess/study.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace hyoryu {

/// One process to start: a run of the study, for the first or another time.
struct StudyJob {
    std::size_t run = 0;
    int repeat = 1;
    std::filesystem::path folder;
    std::string asked; // the case and its overrides: an earlier result is reused if it has the same
    double memory = 0; // forecast [B]
};

struct StudyJobSettings {
    int threads = 1; // of each process
    int side_by_side = 1;
};

/// Whether an earlier call has made the results of this very job.
bool is_done(const StudyJob& job);

/// Makes the job count as not done; its results stay until a run replaces them.
void forget(const StudyJob& job);

/// Runs the unfinished jobs in order, as many in parallel as requested and as memory allows. Prints
/// a line for each. Returns why each job stopped, empty if it finished; fewer entries than jobs if
/// the user requested a stop.
std::vector<std::string> run_jobs(const Study& study, const std::vector<StudyRun>& runs,
                                  const std::vector<StudyJob>& jobs,
                                  const StudyJobSettings& settings);

} // namespace hyoryu
