// SPDX-License-Identifier: MIT
// The completion script for bash. It needs no library of completions, and bash 4.4.
#include "command_texts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

namespace hyoryu {

namespace {

using Kind = ValueCandidates::Kind;

// The line of the script that offers the candidates.
std::string bash_action(const ValueCandidates& candidates)
{
    if (candidates.kind == Kind::words) {
        return fmt::format("_hyoryu_words '{}'", fmt::join(candidates.words, " "));
    }
    constexpr std::array actions{":", "", "_hyoryu_files", "_hyoryu_files '!*.toml'",
                                 "_hyoryu_folders"}; // in the order of `Kind`
    return actions[static_cast<std::size_t>(candidates.kind)];
}

std::vector<std::string> dashed_names(const CommandText& command)
{
    std::vector<std::string> names;
    for (const OptionText& option : command.options) {
        names.insert(names.end(), option.names.begin(), option.names.end());
    }
    return names;
}

// One branch an option that takes a value: it sets `action`, so that the next word is its value.
std::string value_branches(const CommandText& command)
{
    std::string text;
    for (const OptionText& option : command.options) {
        if (!option.value.empty()) {
            text += fmt::format("        '{0} {1}') action=\"{2}\" ;;\n", command.name,
                                fmt::join(option.names, fmt::format("' | '{} ", command.name)),
                                bash_action(option.candidates));
        }
    }
    return text;
}

std::string place_branches(const CommandText& command)
{
    std::string text;
    for (std::size_t k = 0; k < command.places.size(); ++k) {
        const OptionText& option = command.places[k];
        text +=
            fmt::format("    '{} '{}) {} ;;\n", command.name,
                        option.repeats ? "*" : std::to_string(k), bash_action(option.candidates));
    }
    return text;
}

constexpr const char* helpers =
    R"(# Completion of hyoryu for bash, made by `hyoryu completions bash`.
_hyoryu_words()
{
    mapfile -t COMPREPLY < <(compgen -W "$1" -- "$word")
}
_hyoryu_folders()
{
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -d -- "$word")
}
_hyoryu_files()
{
    compopt -o filenames 2>/dev/null
    if [[ $1 ]]; then # of files only those, and every folder
        mapfile -t COMPREPLY < <(compgen -d -- "$word"; compgen -f -X "$1" -- "$word")
    else
        mapfile -t COMPREPLY < <(compgen -f -- "$word")
    fi
}
# Sets action to what offers values of an option of a command, or to nothing.
_hyoryu_value()
{
    action=
    case "$1 $2" in
)";

constexpr const char* begin_of_function = R"(    esac
}
_hyoryu()
{
    local command=${COMP_WORDS[1]} word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
    local action= place=0 k
    COMPREPLY=()
    # bash takes --option=value for three words
    if [[ $word == "=" ]]; then
        word=
    elif [[ $before == "=" ]]; then
        before=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    if ((COMP_CWORD == 1)); then
)";

constexpr const char* middle_of_function = R"(        return
    fi
    _hyoryu_value "$command" "$before"
    if [[ $action ]]; then
        eval "$action"
        return
    fi
    for ((k = 2; k < COMP_CWORD; ++k)); do
        _hyoryu_value "$command" "${COMP_WORDS[k]}"
        if [[ $action ]]; then
            [[ ${COMP_WORDS[k + 1]} == "=" ]] && k=$((k + 1))
            k=$((k + 1))
        elif [[ ${COMP_WORDS[k]} != -* ]]; then
            place=$((place + 1))
        fi
    done
    if [[ $word == -* ]]; then
        case $command in
)";

} // namespace

std::string bash_completion(const ProgramText& texts)
{
    std::vector<std::string> first_words;
    std::string values;
    std::string options;
    std::string places;
    for (const CommandText& command : texts.commands) {
        first_words.push_back(command.name);
        values += value_branches(command);
        options += fmt::format("        {}) _hyoryu_words '{}' ;;\n", command.name,
                               fmt::join(dashed_names(command), " "));
        places += place_branches(command);
    }
    for (const std::string& name : dashed_names(texts.program)) {
        first_words.push_back(name);
    }
    return helpers + values + begin_of_function +
           fmt::format("        _hyoryu_words '{}'\n", fmt::join(first_words, " ")) +
           middle_of_function + options + "        esac\n        return\n    fi\n" +
           "    case \"$command $place\" in\n" + places +
           "    esac\n}\ncomplete -F _hyoryu hyoryu\n";
}

} // namespace hyoryu
