// SPDX-License-Identifier: MIT
// Processes that this one starts and that do not outlive it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace hyoryu {

/// Where a child runs and what becomes of its messages.
struct ChildSettings {
    std::filesystem::path folder;   // its current folder; empty: that of this process
    std::filesystem::path messages; // output and errors are appended to this file; empty: dropped
};

/// Starts `words[0]`, looked for on the PATH if it holds no slash, with the other words as its
/// arguments and without input. The system kills it when the calling thread ends in whatever way
/// (PR_SET_PDEATHSIG). Returns its number, for `waitpid`, or -1 with the reason in `errno`.
pid_t start_child(std::vector<std::string> words, const ChildSettings& settings);

} // namespace hyoryu
