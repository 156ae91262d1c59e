// SPDX-License-Identifier: MIT
// Ctrl-C, SIGTERM and SIGUSR1 ask a run to stop after the step it is in.
#pragma once

#include <chrono>
#include <filesystem>

namespace hyoryu {

/// From now on the first SIGINT, SIGTERM or SIGHUP is taken as a request, and the second one ends
/// the process at once. A pipe without a reader (SIGPIPE) loses the progress output, not the run.
/// SIGUSR1, which schedulers of clusters send before they end a job, is always a request, however
/// often it arrives.
void watch_for_stop();
/// The part of this for SIGUSR1: while a case is read and filled, the other signals end the process
/// at once, for nothing is written yet.
void watch_for_batch_signal();
bool stop_requested();

/// The file by which `hyoryu stop` asks the run of a results folder to stop.
std::filesystem::path stop_file(const std::filesystem::path& folder);

/// Removes a request that an earlier run has left, before this one can be asked.
void forget_stop_request(const std::filesystem::path& folder);

/// Looks for that file once a second.
class StopFile {
public:
    explicit StopFile(const std::filesystem::path& folder) : file_(stop_file(folder)) {}
    /// Whether the file is there or was; it is removed when it is seen.
    bool requested();

private:
    std::filesystem::path file_;
    std::chrono::steady_clock::time_point looked_ = std::chrono::steady_clock::now();
    bool seen_ = false;
};

} // namespace hyoryu
