// SPDX-License-Identifier: MIT
// Folders and files that a command shares with the user: a mark identifies what the command wrote.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace hyoryu {

/// Files that a command writes directly into a folder.
struct Claim {
    std::string command;                          // "study": names the mark, `.hyoryu-study`
    std::function<bool(const std::string&)> owns; // whether it writes an entry of that name
};

/// Makes the folder, with its parents, and puts the mark of the command into it. A folder with the
/// mark was made by an earlier call: files with the names that the command uses are its own.
/// Without the mark such files belong to the user: throws CaseError that names them, and writes
/// nothing. Other files do not matter. Throws IoError if the folder cannot be written.
void claim_folder(const std::filesystem::path& folder, const Claim& claim);

/// Names of the entries of a folder that `owns` takes for its own, sorted. Throws
/// std::filesystem::filesystem_error.
std::vector<std::string> owned_names(const std::filesystem::path& folder,
                                     const std::function<bool(const std::string&)>& owns);

/// By what a file that a command wrote is recognised.
struct FileMark {
    std::string_view command; // `hyoryu COMMAND` in messages
    std::string_view start;   // its first bytes
    std::string_view within;  // a text among its first 4096 bytes
};

/// Throws CaseError unless the command may write this file: either nothing has that name, or it is
/// a regular file that is empty or has the mark. Symbolic links and devices are refused. Changes
/// nothing.
void expect_own_file(const std::filesystem::path& file, const FileMark& mark);

/// Throws CaseError if a file, or anything else but a folder, has the name of a folder to be.
void expect_no_file(const std::filesystem::path& folder);

/// Throws CaseError if a run could not replace the folder (see `prepare_results`): it is not empty
/// and either no results folder or holds files that no run wrote. Changes nothing.
void expect_replaceable(const std::filesystem::path& folder);

/// Removes the files of a run from the folder, except for the files of these names.
void remove_results_except(const std::filesystem::path& folder,
                           const std::function<bool(const std::string&)>& kept);

} // namespace hyoryu
