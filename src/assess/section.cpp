// SPDX-License-Identifier: MIT
#include "section.hpp"

#include "hyoryu/assess/formula.hpp"
#include "hyoryu/core/name.hpp"
#include "hyoryu/io/results.hpp"
#include "hyoryu/scene/reader_hint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace hyoryu {

namespace {

const TomlTable empty_table;

const TomlTable& table_of(const TomlNode& node)
{
    return node.table() != nullptr ? *node.table() : empty_table;
}

} // namespace

void BenchmarkFile::error(const Place& place, std::string key, std::string what, std::string hint)
{
    Diagnostic mistake{.file = file.string(),
                       .line = place.line,
                       .column = place.column,
                       .length = place.length,
                       .key = std::move(key),
                       .what = std::move(what),
                       .hint = std::move(hint)};
    if (place.line > 0 && static_cast<std::size_t>(place.line) <= lines.size()) {
        mistake.source = lines[static_cast<std::size_t>(place.line) - 1];
    }
    mistakes.push_back(std::move(mistake));
}

void BenchmarkFile::expect_no_mistakes() const
{
    if (!mistakes.empty()) {
        throw CaseError(mistakes);
    }
}

Section::Section(BenchmarkFile& file, const TomlNode& node, std::string path)
    : file_(&file), node_(node), path_(std::move(path))
{
    if (node_.table() == nullptr) {
        file_->error(node_.place, path_, fmt::format("expected a table, found {}", found(node_)));
    }
}

std::string Section::full(std::string_view key) const
{
    return path_.empty() || key.empty() ? fmt::format("{}{}", path_, key)
                                        : fmt::format("{}.{}", path_, key);
}

bool Section::has(std::string_view key) const
{
    return find_entry(table_of(node_), key) != nullptr;
}

Place Section::place_of(std::string_view key) const
{
    const TomlEntry* entry = find_entry(table_of(node_), key);
    return entry != nullptr ? entry->node.place : node_.place;
}

const TomlEntry* Section::ask(std::string_view key)
{
    asked_.emplace_back(key);
    return find_entry(table_of(node_), key);
}

void Section::error(std::string_view key, std::string what, std::string hint)
{
    file_->error(place_of(key), full(key), std::move(what), std::move(hint));
}

void Section::mistyped(const TomlEntry& entry, std::string_view expected)
{
    error(entry.key, fmt::format("expected {}, found {}", expected, found(entry.node)));
}

void Section::require(std::string_view key)
{
    if (!has(key)) {
        error(key, "is missing", fmt::format("write {} = followed by its value", key));
    }
}

template <class T>
T Section::value(std::string_view key, T fallback, std::string_view expected)
{
    const TomlEntry* entry = ask(key);
    if (entry == nullptr) {
        return fallback;
    }
    auto value = value_in<T>(entry->node);
    if (!value) {
        mistyped(*entry, expected);
    }
    return std::move(value).value_or(std::move(fallback));
}

template <class T>
std::vector<T> Section::list(std::string_view key, std::string_view expected)
{
    std::vector<T> values;
    for (const TomlNode* item : items(key, fmt::format("a list of {}s", expected))) {
        if (auto value = value_in<T>(*item)) {
            values.push_back(std::move(*value));
        } else {
            file_->error(item->place, full(key),
                         fmt::format("expected a {}, found {}", expected, found(*item)));
        }
    }
    return values;
}

std::string Section::text(std::string_view key, std::string fallback)
{
    return value<std::string>(key, std::move(fallback), "a text");
}

std::string Section::label(std::string_view key, std::string fallback)
{
    std::string label = text(key, std::move(fallback));
    const std::string fault = label_fault(label);
    if (!fault.empty()) {
        error(key, "cannot be shown: " + fault);
    }
    return label;
}

double Section::number(std::string_view key, double fallback)
{
    return value<double>(key, fallback, "a number");
}

std::int64_t Section::integer(std::string_view key, std::int64_t fallback)
{
    return value<std::int64_t>(key, fallback, "a whole number");
}

std::vector<std::string> Section::texts(std::string_view key)
{
    return list<std::string>(key, "text");
}

std::vector<double> Section::numbers(std::string_view key)
{
    return list<double>(key, "number");
}

std::optional<std::size_t> Section::choice(std::string_view key,
                                           std::span<const std::string_view> names)
{
    const std::string name = text(key);
    const auto at = std::ranges::find(names, name);
    if (at != names.end()) {
        return static_cast<std::size_t>(at - names.begin());
    }
    if (has(key)) {
        const std::string near = did_you_mean(name, names);
        error(key, fmt::format("unknown \"{}\"", name),
              near.empty() ? "known: " + quoted_list(names) : near);
    }
    return std::nullopt;
}

std::string Section::expression(std::string_view key)
{
    const TomlEntry* entry = ask(key);
    return entry == nullptr ? std::string() : checked_expression(*file_, entry->node, full(key));
}

std::optional<Section> Section::table(std::string_view key)
{
    const TomlEntry* entry = ask(key);
    return entry == nullptr ? std::nullopt : std::optional(Section(*file_, entry->node, full(key)));
}

std::vector<Section> Section::tables(std::string_view key)
{
    std::vector<Section> sections;
    for (const TomlNode* item : items(key, fmt::format("a list of tables [[{}]]", full(key)))) {
        sections.emplace_back(*file_, *item, fmt::format("{}[{}]", full(key), sections.size()));
    }
    return sections;
}

std::vector<const TomlNode*> Section::items(std::string_view key, std::string_view expected)
{
    const TomlEntry* entry = ask(key);
    std::vector<const TomlNode*> result;
    if (entry != nullptr && entry->node.array() == nullptr) {
        mistyped(*entry, expected);
    } else if (entry != nullptr) {
        for (const TomlNode& item : *entry->node.array()) {
            result.push_back(&item);
        }
    }
    return result;
}

std::vector<const TomlEntry*> Section::entries(std::string_view key)
{
    const TomlEntry* entry = ask(key);
    std::vector<const TomlEntry*> result;
    if (entry != nullptr && entry->node.table() == nullptr) {
        mistyped(*entry, "a table");
    } else if (entry != nullptr) {
        for (const TomlEntry& inner : *entry->node.table()) {
            result.push_back(&inner);
        }
    }
    // The parser sorts keys by name; they are read in the order of the file.
    std::sort(result.begin(), result.end(), [](const TomlEntry* a, const TomlEntry* b) {
        return std::tie(a->place.line, a->place.column) < std::tie(b->place.line, b->place.column);
    });
    return result;
}

void Section::finish()
{
    const std::vector<std::string_view> known(asked_.begin(), asked_.end());
    for (const TomlEntry& entry : table_of(node_)) {
        if (std::find(known.begin(), known.end(), entry.key) == known.end()) {
            file_->error(entry.place, full(entry.key), "unknown key",
                         did_you_mean(entry.key, known));
        }
    }
}

std::optional<std::string> scalar_text(const TomlNode& node)
{
    const auto number = value_in<double>(node);
    return number ? std::optional(cell(*number)) : value_in<std::string>(node);
}

std::string checked_expression(BenchmarkFile& file, const TomlNode& node, const std::string& key)
{
    const auto text = scalar_text(node);
    if (!text) {
        file.error(node.place, key,
                   fmt::format("expected a number or an expression, found {}", found(node)));
        return "0";
    }
    try {
        const Formula syntax(*text);
    } catch (const FormulaError& fault) {
        file.error(node.place, key, fault.what());
        return "0";
    }
    return *text;
}

} // namespace hyoryu
