// SPDX-License-Identifier: MIT
// `key.path=VALUE` on the command line: the value put into the tree of the case file.
#include "hyoryu/scene/toml_document.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

namespace hyoryu {

namespace {

/// One step of a key path: a key and, for a list, the number of its element.
struct PathStep {
    std::string key;
    std::optional<std::size_t> index;
};

std::string_view trimmed(std::string_view text)
{
    constexpr std::string_view blanks = " \t\r\n";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

bool is_key(std::string_view text)
{
    return !text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyz"
                                                   "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") ==
                                std::string_view::npos;
}

std::optional<PathStep> parse_step(std::string_view text)
{
    PathStep step;
    const auto bracket = text.find('[');
    step.key = text.substr(0, bracket);
    if (bracket != std::string_view::npos) {
        std::size_t index = 0;
        const char* const end = text.data() + text.size();
        const auto [stop, fault] = std::from_chars(text.data() + bracket + 1, end, index);
        if (fault != std::errc{} || end - stop != 1 || *stop != ']') {
            return std::nullopt;
        }
        step.index = index;
    }
    return is_key(step.key) ? std::optional(step) : std::nullopt;
}

std::optional<std::vector<PathStep>> parse_path(std::string_view path)
{
    constexpr std::size_t most_steps = 16;
    std::vector<PathStep> steps;
    while (steps.size() < most_steps) {
        const auto dot = path.find('.');
        const auto step = parse_step(trimmed(path.substr(0, dot)));
        if (!step) {
            return std::nullopt;
        }
        steps.push_back(*step);
        if (dot == std::string_view::npos) {
            return steps;
        }
        path.remove_prefix(dot + 1);
    }
    return std::nullopt;
}

void mark(TomlNode& node, int number)
{
    node.override_number = number;
    node.place = {};
    if (auto* items = node.array()) {
        for (TomlNode& item : *items) {
            mark(item, number);
        }
    } else if (auto* entries = node.table()) {
        for (TomlEntry& entry : *entries) {
            entry.place = {};
            mark(entry.node, number);
        }
    }
}

/// VALUE as TOML; plain words that are not TOML ("laminar", "10 cm") are taken as a text.
std::optional<TomlNode> parse_value(std::string_view value)
{
    try {
        TomlNode document = parse_toml(fmt::format("value = {}", value));
        TomlTable& table = *document.table();
        return table.size() == 1 ? std::optional(std::move(table.front().node)) : std::nullopt;
    } catch (const TomlFault&) {
        if (value.empty() || value.find_first_of("\"'[]{}=#\n\r") != std::string_view::npos) {
            return std::nullopt;
        }
        return TomlNode{std::string(value), {}, -1};
    }
}

/// The value that a step leads to, added as a table if there was none; null if the step leads
/// nowhere.
TomlNode* follow(TomlNode& from, const PathStep& step, int number)
{
    TomlTable* table = from.table();
    if (table == nullptr) {
        return nullptr;
    }
    TomlEntry* entry = find_entry(*table, step.key);
    if (entry == nullptr) {
        if (step.index) {
            return nullptr;
        }
        table->push_back({step.key, {}, TomlNode{TomlTable{}, {}, number}});
        return &table->back().node;
    }
    if (!step.index) {
        return &entry->node;
    }
    TomlArray* items = entry->node.array();
    return items != nullptr && *step.index < items->size() ? &(*items)[*step.index] : nullptr;
}

} // namespace

std::string apply_override(TomlNode& root, std::string_view text, int number)
{
    const auto equals = text.find('=');
    if (equals == std::string_view::npos) {
        return fmt::format("expected key.path=VALUE, found \"{}\"", text);
    }
    const auto steps = parse_path(text.substr(0, equals));
    if (!steps) {
        return fmt::format("\"{}\" is not a key: expected names separated by dots, and [0], [1] "
                           "... for the elements of a list",
                           trimmed(text.substr(0, equals)));
    }
    auto value = parse_value(trimmed(text.substr(equals + 1)));
    if (!value) {
        return fmt::format("\"{}\" is not a TOML value", trimmed(text.substr(equals + 1)));
    }
    TomlNode* node = &root;
    for (const PathStep& step : *steps) {
        node = follow(*node, step, number);
        if (node == nullptr) {
            return step.index ? fmt::format("the case has no `{}[{}]`", step.key, *step.index)
                              : fmt::format("`{}` is not a key of a table here", step.key);
        }
    }
    mark(*value, number);
    *node = std::move(*value);
    return {};
}

} // namespace hyoryu
