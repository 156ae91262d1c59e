// SPDX-License-Identifier: MIT
// `hyoryu stop`: a file in the results folder, which the run looks for. It reaches a run on another
// machine, and one that mpirun has started, to which Ctrl-C does not leave the time for a
// checkpoint.
#include "commands.hpp"
#include "options.hpp"
#include "stop_request.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/io/results.hpp"

#include <fmt/format.h>

namespace hyoryu {

namespace {

// Whether a run holds the folder, which exists.
bool is_running(const std::filesystem::path& folder)
{
    try {
        const FolderLock lock(folder);
        return false;
    } catch (const CaseError&) {
        return true;
    }
}

} // namespace

int stop_run(const StopOptions& options)
{
    std::error_code fault;
    const bool running =
        std::filesystem::is_directory(options.folder, fault) && is_running(options.folder);
    if (!running) {
        expect_results(options.folder);
        throw CaseError(fmt::format("no run is writing to `{}`", options.folder.string()),
                        "only a run that is in progress can be stopped");
    }
    write_text(stop_file(options.folder), "This file tells the run to stop.\n");
    fmt::print("the run will write a checkpoint and end after the current step\n");
    return exit_code::done;
}

} // namespace hyoryu
