// SPDX-License-Identifier: MIT
// Runs of this program as processes, several at a time.
#pragma once

#include "commands.hpp"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace hyoryu {

/// One process of this program.
struct ProcessJob {
    std::size_t number = 0;             // by which the caller knows it
    std::vector<std::string> arguments; // of the program
    double memory = 0;                  // forecast [B]
};

/// The arguments of a quiet `hyoryu run` that replaces the results in its folder. Case, folder,
/// overrides and threads of `run` count.
std::vector<std::string> run_arguments(const RunOptions& run);

/// Processes of this program, as many at a time as requested and as memory allows.
class ProcessPool {
public:
    /// Called after the end of a process, with the number of its job and the reason of a failure;
    /// the reason is empty if the process succeeded.
    using Ended = std::function<void(std::size_t number, const std::string& error)>;

    ProcessPool(int side_by_side, Ended ended)
        : side_by_side_(side_by_side), ended_(std::move(ended))
    {
    }

    /// Starts the job as soon as there is room for it. After a request to stop it starts nothing.
    /// Throws IoError if no process can be started, or no temporary file for its messages created.
    void start(const ProcessJob& job);

    /// Waits for all processes. They receive a request to stop; `ended` is not called after one.
    void wait_for_all();

private:
    struct Running {
        std::size_t number = 0;
        pid_t process = 0;
        std::filesystem::path messages;
        double memory = 0;
    };

    bool fits(const ProcessJob& job) const;
    void hand_on_a_request();
    void wait_for_one();

    int side_by_side_;
    Ended ended_;
    std::vector<Running> running_;
    bool handed_on_ = false; // the user's request to stop
};

} // namespace hyoryu
