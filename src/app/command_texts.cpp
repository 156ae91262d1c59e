// SPDX-License-Identifier: MIT
#include "command_texts.hpp"

#include "templates.hpp"

#include "hyoryu/scene/parameter.hpp"

#include <CLI/CLI.hpp>

#include <map>
#include <sstream>

namespace hyoryu {

namespace {

using Kind = ValueCandidates::Kind;

ValueCandidates words_between_bars(const std::string& text)
{
    ValueCandidates candidates{Kind::words, {}};
    std::istringstream stream(text);
    for (std::string word; std::getline(stream, word, '|');) {
        candidates.words.push_back(word);
    }
    return candidates;
}

// One of the texts of each thing.
ValueCandidates words_of(const auto& things, auto text)
{
    ValueCandidates candidates{Kind::words, {}};
    for (const auto& thing : things) {
        candidates.words.emplace_back(thing.*text);
    }
    return candidates;
}

ValueCandidates candidates_for(const CLI::App& program, const std::string& value)
{
    const std::map<std::string, ValueCandidates> known{
        {"FILE", {Kind::files, {}}},
        {"FILE.toml", {Kind::toml_files, {}}},
        {"FOLDER", {Kind::folders, {}}},
        {"COMMAND", {Kind::words, command_names(program)}},
        {"KEY", words_of(parameters(), &Parameter::key)},
        {"TEMPLATE", words_of(templates(), &Template::name)}};
    if (const auto found = known.find(value); found != known.end()) {
        return found->second;
    }
    return value.find('|') != std::string::npos ? words_between_bars(value) : ValueCandidates{};
}

// Without the bounds, which validators add behind a colon.
std::string value_name(const CLI::Option& option)
{
    if (option.get_items_expected_max() == 0) {
        return {}; // a flag
    }
    const std::string name = option.get_type_name();
    return name.substr(0, name.find(':'));
}

OptionText text_of(const CLI::App& program, const CLI::Option& option)
{
    OptionText text;
    for (const std::string& name : option.get_snames()) {
        text.names.push_back("-" + name);
    }
    for (const std::string& name : option.get_lnames()) {
        text.names.push_back("--" + name);
    }
    if (text.names.empty()) {
        text.place = option.get_name(true);
    }
    text.value = value_name(option);
    text.description = option.get_description();
    text.candidates = candidates_for(program, text.value);
    text.required = option.get_required();
    text.repeats = option.get_expected_max() > 1;
    return text;
}

CommandText text_of(const CLI::App& program, const CLI::App& command)
{
    CommandText text;
    text.name = &command == &program ? "" : command.get_name();
    text.description = command.get_description();
    text.footer = command.get_footer();
    for (const CLI::Option* option : command.get_options()) {
        OptionText one = text_of(program, *option);
        (one.names.empty() ? text.places : text.options).push_back(std::move(one));
    }
    return text;
}

} // namespace

std::vector<std::string> command_names(const CLI::App& program)
{
    std::vector<std::string> names;
    for (const CLI::App* command : program.get_subcommands(nullptr)) {
        names.push_back(command->get_name());
    }
    return names;
}

ProgramText texts_of(const CLI::App& program)
{
    ProgramText texts{text_of(program, program), {}};
    for (const CLI::App* command : program.get_subcommands(nullptr)) {
        texts.commands.push_back(text_of(program, *command));
    }
    return texts;
}

} // namespace hyoryu
