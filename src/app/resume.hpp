// SPDX-License-Identifier: MIT
// Going on from a checkpoint with a case that may have changed.
#pragma once

#include "commands.hpp"

#include "hyoryu/io/results.hpp"
#include "hyoryu/ranks/comm.hpp"
#include "hyoryu/scene/scene.hpp"

#include <filesystem>
#include <map>
#include <string>

namespace hyoryu {

/// The scene and state with which a run resumes.
struct Resumption {
    Snapshot state;                         // for the case as it is now; of the process that writes
    std::vector<CheckpointPart> parts = {}; // with the particles; empty if the state has them
    Scene scene;                            // the case, with defaults taken from the previous run
    std::string passed_over;                // why `checkpoint.h5` was not read; empty if it was
    bool changed = false; // whether the case is not the one that wrote the checkpoint
};

/// Texts for checkpoints beside the resolved case: hashes of the files that it names, by which a
/// changed one is noticed; and, if it has [[debris]], the case as it was given: the resolved case
/// has their pieces as bodies, and a refusal names the keys that the user wrote.
std::map<std::string, std::string> texts_of_given_case(const RunOptions& options,
                                                       const Scene& scene);

/// Reads the newest checkpoint of the folder and fits it to the case. Where `output.every` is left
/// to its default, end / 100, in both cases, it stays as it was: a later end moves no frame. Throws
/// CaseError that names every key that may not change, with both values, and IoError if there is no
/// checkpoint that can be read. Called by all processes that share a run, of which the one that
/// writes reads the checkpoint: the others get no state. `comm`: null for one process.
Resumption resumption_for_all(const RunOptions& options, const std::filesystem::path& folder,
                              const Scene& scene, Comm* comm);

/// The command line that goes on with the run, for a shell.
std::string command_to_go_on(const RunOptions& options, const std::filesystem::path& folder);

} // namespace hyoryu
