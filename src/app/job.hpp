// SPDX-License-Identifier: MIT
// A run in progress.
#pragma once

#include "commands.hpp"
#include "frame_output.hpp"
#include "machine_load.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include "rank_log.hpp"
#include "resume.hpp"

#include "hyoryu/io/kept_state.hpp"
#include "hyoryu/io/results.hpp"

#include <limits>

namespace hyoryu {

struct Job {
    std::filesystem::path folder;
    std::string case_text;
    Simulation sim;
    Comm* comm = nullptr; // of the processes that share the run; null for one
    RankLog* ranks = nullptr;
    Groups groups = {}; // of processes that write their particles to one file
    std::optional<FrameOutput> frames = {};
    /// Lock and histories exist only on the process that writes the histories.
    std::optional<FolderLock> lock = {};
    std::optional<Outputs> outputs = {};
    Progress progress = {};
    std::int64_t first_step = 0;
    std::int64_t good_step = 0;  // of `last_good`
    std::int64_t saved_step = 0; // of the last checkpoint
    /// At the last frame, of this process; none while the checkpoint on disk is newer and no
    /// recovery needs it.
    std::optional<KeptState> last_good = {};
    double until = infinity;
    bool stopped = false;              // on request
    std::string command_to_go_on = {}; // for the user, where the run stops before its end
    CoreWatch cores = {};
    std::map<std::string, std::string> given = {}; // texts of checkpoints beside the case
};

/// Input for the start of a run.
struct Beginning {
    const RunOptions& options;
    std::filesystem::path folder;
    const Scene& scene;
    const Plan& plan;
    CountedComm* comm = nullptr;
    RankLog* ranks = nullptr;
};

/// A run from time 0, and one that goes on from a checkpoint. The filling, and the state of a
/// checkpoint, are those of the process that writes.
Job start(const Beginning& from, Filling filling);
Job resume(const Beginning& from, Resumption state, Filling filling);

/// Keeps the present state as the one to return to.
void keep_good_state(Job& job);
/// Writes the output that is due, and with a frame keeps the state as the one to return to; called
/// after each step and once before the first.
void update_outputs(Job& job);
/// Writes the present state to the disk. It takes the place of an older one in memory, unless the
/// run may return to that: a recovery must not depend on when checkpoints were written.
void write_checkpoint(Job& job);
/// Writes a state of which each process has its share.
void write_state(Job& job, StateOnDemand state);
/// Waits until histories and frames so far are on disk.
void settle(Job& job);

} // namespace hyoryu
