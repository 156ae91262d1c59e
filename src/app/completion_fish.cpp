// SPDX-License-Identifier: MIT
// The completion script for fish: one `complete` a command, option and place.
#include "command_texts.hpp"

#include "hyoryu/core/name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

namespace hyoryu {

namespace {

using Kind = ValueCandidates::Kind;

// Within single quotes of fish.
std::string in_quotes(std::string_view text)
{
    return "'" + replaced(text, {{'\'', "\\'"}, {'\\', "\\\\"}}) + "'";
}

std::string candidates_of(const ValueCandidates& candidates)
{
    if (candidates.kind == Kind::words) {
        return " -a " + in_quotes(fmt::format("{}", fmt::join(candidates.words, " ")));
    }
    constexpr std::array actions{"", "", " -F", " -a '(__fish_complete_suffix .toml)'",
                                 " -a '(__fish_complete_directories)'"}; // in the order of `Kind`
    return actions[static_cast<std::size_t>(candidates.kind)];
}

// "-s o -l output"
std::string switches_of(const OptionText& option)
{
    std::string text;
    for (const std::string& name : option.names) {
        const bool is_long = name.starts_with("--");
        text += fmt::format(" {} {}", is_long ? "-l" : "-s", name.substr(is_long ? 2 : 1));
    }
    return text;
}

std::string lines_of(const CommandText& command, const std::string& condition)
{
    std::string text;
    for (const OptionText& option : command.options) {
        text += fmt::format("complete -c hyoryu -n {}{}{}{} -d {}\n", in_quotes(condition),
                            switches_of(option), option.value.empty() ? "" : " -r",
                            candidates_of(option.candidates), in_quotes(option.description));
    }
    for (const OptionText& place : command.places) {
        if (place.candidates.kind != Kind::none) {
            text += fmt::format("complete -c hyoryu -n {}{}\n", in_quotes(condition),
                                candidates_of(place.candidates));
        }
    }
    return text;
}

} // namespace

std::string fish_completion(const ProgramText& texts)
{
    const std::string no_command = "__fish_use_subcommand";
    std::string text = "# Completion of hyoryu for fish, made by `hyoryu completions fish`.\n"
                       "complete -c hyoryu -f\n" +
                       lines_of(texts.program, no_command);
    for (const CommandText& command : texts.commands) {
        text += fmt::format("complete -c hyoryu -n {} -a {} -d {}\n", in_quotes(no_command),
                            command.name, in_quotes(command.description));
    }
    for (const CommandText& command : texts.commands) {
        text += lines_of(command, "__fish_seen_subcommand_from " + command.name);
    }
    return text;
}

} // namespace hyoryu
