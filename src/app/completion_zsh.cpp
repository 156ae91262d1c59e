// SPDX-License-Identifier: MIT
// The completion script for zsh: specifications for its `_arguments`, one command after the other.
#include "command_texts.hpp"

#include "hyoryu/core/name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

namespace hyoryu {

namespace {

using Kind = ValueCandidates::Kind;

// A text within a specification within single quotes.
std::string spec(std::string_view text)
{
    return replaced(text,
                    {{'\'', "'\\''"}, {'[', "\\["}, {']', "\\]"}, {':', "\\:"}, {'\\', "\\\\"}});
}

std::string zsh_action(const ValueCandidates& candidates)
{
    if (candidates.kind == Kind::words) {
        return fmt::format("({})", spec(fmt::format("{}", fmt::join(candidates.words, " "))));
    }
    constexpr std::array actions{" ", "", "_files", "_files -g \"*.toml\"",
                                 "_files -/"}; // in the order of `Kind`
    return actions[static_cast<std::size_t>(candidates.kind)];
}

// '(-o --output)'{-o,--output}'[results folder]:FOLDER:_files -/'
std::string option_spec(const OptionText& option)
{
    const std::string names = option.names.size() == 1
                                  ? "'" + option.names.front()
                                  : fmt::format("'({})'{{{}}}'", fmt::join(option.names, " "),
                                                fmt::join(option.names, ","));
    const std::string value = option.value.empty() ? ""
                                                   : fmt::format(":{}:{}", spec(option.value),
                                                                 zsh_action(option.candidates));
    return fmt::format("{}[{}]{}'", names, spec(option.description), value);
}

std::string specs_of(const CommandText& command)
{
    std::string text;
    for (const OptionText& option : command.options) {
        text += " \\\n        " + option_spec(option);
    }
    for (std::size_t k = 0; k < command.places.size(); ++k) {
        const OptionText& place = command.places[k];
        text += fmt::format(" \\\n        '{}:{}:{}'", place.repeats ? "*" : std::to_string(k + 1),
                            spec(place.place), zsh_action(place.candidates));
    }
    return text;
}

} // namespace

std::string zsh_completion(const ProgramText& texts)
{
    std::string commands;
    std::string branches;
    for (const CommandText& command : texts.commands) {
        commands += fmt::format("        '{}:{}'\n", command.name, spec(command.description));
        branches +=
            fmt::format("    {})\n        _arguments{} ;;\n", command.name, specs_of(command));
    }
    return "#compdef hyoryu\n# Completion of hyoryu for zsh, made by `hyoryu completions zsh`.\n"
           "_hyoryu()\n{\n    local -a commands\n    commands=(\n" +
           commands +
           "    )\n    if (( CURRENT == 2 )); then\n        _describe command commands\n" +
           "        _arguments" + specs_of(texts.program) + "\n        return\n    fi\n" +
           "    shift words\n    (( CURRENT -= 1 ))\n    case $words[1] in\n" + branches +
           "    esac\n}\n" +
           "if [[ $zsh_eval_context[-1] == loadautofunc ]]; then\n    _hyoryu \"$@\"\nelse\n"
           "    compdef _hyoryu hyoryu\nfi\n";
}

} // namespace hyoryu
