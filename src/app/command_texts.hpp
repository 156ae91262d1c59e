// SPDX-License-Identifier: MIT
// The commands and options as plain data: the source of the manual pages and of the scripts by
// which shells complete command lines.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace hyoryu {

/// Candidates for a value that a shell offers.
struct ValueCandidates {
    enum class Kind { none, words, files, toml_files, folders };
    Kind kind = Kind::none;
    std::vector<std::string> words;
};

struct OptionText {
    std::vector<std::string> names; // "-o", "--output"; empty: it is known by its place
    std::string place;              // "CASE", of an option without names
    std::string value;              // as help calls it: "FOLDER", "vtp|csv"; empty: a flag
    std::string description;
    ValueCandidates candidates; // for the value
    bool required = false;
    bool repeats = false;
};

struct CommandText {
    std::string name; // empty: the program itself
    std::string description;
    std::string footer;
    std::vector<OptionText> places;
    std::vector<OptionText> options;
};

struct ProgramText {
    CommandText program;
    std::vector<CommandText> commands; // in the order of the help
};

/// The candidates for a value follow from its name: FILE, FILE.toml, FOLDER, COMMAND, KEY (of the
/// case file), TEMPLATE, or words between bars.
ProgramText texts_of(const CLI::App& program);

std::vector<std::string> command_names(const CLI::App& program);

/// The manual page of a command, or of the program where the name is empty, as roff for `man -l`.
/// Throws CaseError with the nearest command if there is none of that name.
std::string manual_page(const ProgramText& texts, const std::string& command);

/// The script with which a shell completes command lines of the program.
std::string bash_completion(const ProgramText& texts);
std::string zsh_completion(const ProgramText& texts);
std::string fish_completion(const ProgramText& texts);

} // namespace hyoryu
