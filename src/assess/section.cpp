// SPDX-License-Identifier: MIT
#include "hyoryu/assess/section.hpp"

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

std::optional<double> number_of(const TomlNode& node)
{
    if (const auto* integer = std::get_if<std::int64_t>(&node.value)) {
        return static_cast<double>(*integer);
    }
    const auto* number = std::get_if<double>(&node.value);
    return number != nullptr ? std::optional(*number) : std::nullopt;
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
        error(key, "is missing");
    }
}

std::string Section::text(std::string_view key, std::string fallback)
{
    const TomlEntry* entry = ask(key);
    if (entry == nullptr) {
        return fallback;
    }
    const auto* value = std::get_if<std::string>(&entry->node.value);
    if (value == nullptr) {
        mistyped(*entry, "a text");
        return fallback;
    }
    return *value;
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
    const TomlEntry* entry = ask(key);
    if (entry == nullptr) {
        return fallback;
    }
    const auto value = number_of(entry->node);
    if (!value) {
        mistyped(*entry, "a number");
    }
    return value.value_or(fallback);
}

std::int64_t Section::integer(std::string_view key, std::int64_t fallback)
{
    const TomlEntry* entry = ask(key);
    if (entry == nullptr) {
        return fallback;
    }
    const auto* value = std::get_if<std::int64_t>(&entry->node.value);
    if (value == nullptr) {
        mistyped(*entry, "a whole number");
        return fallback;
    }
    return *value;
}

std::vector<std::string> Section::texts(std::string_view key)
{
    const TomlEntry* entry = ask(key);
    std::vector<std::string> values;
    if (entry == nullptr) {
        return values;
    }
    const TomlArray* items = entry->node.array();
    if (items == nullptr) {
        mistyped(*entry, "a list of texts");
        return values;
    }
    for (const TomlNode& item : *items) {
        if (const auto* value = std::get_if<std::string>(&item.value)) {
            values.push_back(*value);
        } else {
            file_->error(item.place, full(key),
                         fmt::format("expected a text, found {}", found(item)));
        }
    }
    return values;
}

std::vector<double> Section::numbers(std::string_view key)
{
    const TomlEntry* entry = ask(key);
    std::vector<double> values;
    if (entry == nullptr) {
        return values;
    }
    const TomlArray* items = entry->node.array();
    if (items == nullptr) {
        mistyped(*entry, "a list of numbers");
        return values;
    }
    for (const TomlNode& item : *items) {
        if (const auto value = number_of(item)) {
            values.push_back(*value);
        } else {
            file_->error(item.place, full(key),
                         fmt::format("expected a number, found {}", found(item)));
        }
    }
    return values;
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
    const TomlEntry* entry = ask(key);
    std::vector<Section> sections;
    if (entry == nullptr) {
        return sections;
    }
    const TomlArray* items = entry->node.array();
    if (items == nullptr) {
        mistyped(*entry, fmt::format("a list of tables [[{}]]", full(key)));
        return sections;
    }
    for (std::size_t k = 0; k < items->size(); ++k) {
        sections.emplace_back(*file_, (*items)[k], fmt::format("{}[{}]", full(key), k));
    }
    return sections;
}

std::vector<const TomlNode*> Section::items(std::string_view key)
{
    const TomlEntry* entry = ask(key);
    std::vector<const TomlNode*> result;
    if (entry == nullptr) {
        return result;
    }
    const TomlArray* items = entry->node.array();
    if (items == nullptr) {
        mistyped(*entry, "a list");
        return result;
    }
    for (const TomlNode& item : *items) {
        result.push_back(&item);
    }
    return result;
}

std::vector<const TomlEntry*> Section::entries(std::string_view key)
{
    const TomlEntry* entry = ask(key);
    std::vector<const TomlEntry*> result;
    if (entry == nullptr) {
        return result;
    }
    if (entry->node.table() == nullptr) {
        mistyped(*entry, "a table");
        return result;
    }
    for (const TomlEntry& inner : *entry->node.table()) {
        result.push_back(&inner);
    }
    // The parser sorts keys by name; what was typed first is read first.
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
    if (const auto* text = std::get_if<std::string>(&node.value)) {
        return *text;
    }
    const auto number = number_of(node);
    return number ? std::optional(cell(*number)) : std::nullopt;
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
