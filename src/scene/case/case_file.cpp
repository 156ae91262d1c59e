// SPDX-License-Identifier: MIT
#include "hyoryu/scene/case_file.hpp"

#include "hyoryu/core/input_file.hpp"

#include "keys_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>

namespace hyoryu {

namespace {

/// Throws the mistakes that were found.
void throw_if_any(const Reading& reading)
{
    if (!reading.diagnostics.empty()) {
        throw CaseError(reading.diagnostics);
    }
}

TomlNode parse_document(const std::string& text, Reading& reading)
{
    TomlNode root;
    try {
        root = parse_toml(text);
    } catch (const TomlFault& fault) {
        reading.error(fault.place, -1, "", fault.what, fault.hint);
        throw_if_any(reading);
    }
    for (std::size_t k = 0; k < reading.overrides.size(); ++k) {
        const int number = static_cast<int>(k);
        const std::string fault = apply_override(root, reading.overrides[k], number);
        if (!fault.empty()) {
            reading.error(Place{}, number, "", fault);
        }
    }
    return root;
}

// Whether the key belongs to a table from which no other place in the scene follows.
bool leaves_the_rest(const Diagnostic& mistake)
{
    return std::ranges::any_of(
        std::array<std::string_view, 4>{"output", "gauge", "contact", "debris"},
        [&](std::string_view table) {
            const std::string_view key = mistake.key;
            return key.starts_with(table) && (key.size() == table.size() ||
                                              key[table.size()] == '.' || key[table.size()] == '[');
        });
}

// The document of a case that was read, or an empty one if its file has changed beyond reading.
TomlNode document_again(const std::string& text, const std::vector<std::string>& overrides)
{
    try {
        Reading reading{.overrides = overrides};
        return parse_document(text, reading);
    } catch (const CaseError&) {
        return {};
    }
}

// The tables of a document by line and column. The root has the place of its first entry, which
// takes precedence.
using TablesByPlace = std::map<std::pair<int, int>, const TomlNode*>;

void list_tables(const TomlNode& node, TablesByPlace& tables)
{
    if (const TomlArray* items = node.array()) {
        for (const TomlNode& item : *items) {
            list_tables(item, tables);
        }
    } else if (const TomlTable* entries = node.table()) {
        for (const TomlEntry& entry : *entries) {
            list_tables(entry.node, tables);
        }
        tables.emplace(std::pair{node.place.line, node.place.column}, &node);
    }
}

// The value of `key`, a name with dots, below a table; nullptr if there is none.
const TomlNode* find_value(const TomlNode* node, std::string_view key)
{
    while (node != nullptr && !key.empty()) {
        const std::size_t end = std::min(key.find('.'), key.size());
        const TomlTable* table = node->table();
        const TomlEntry* entry =
            table != nullptr ? find_entry(*table, key.substr(0, end)) : nullptr;
        node = entry != nullptr ? &entry->node : nullptr;
        key.remove_prefix(std::min(end + 1, key.size()));
    }
    return node;
}

} // namespace

PlacedCaseError::PlacedCaseError(const CaseError& mistakes, Scene scene)
    : CaseError(mistakes), scene_(std::move(scene))
{
    const double end = scene_.time.end;
    scene_.output = {.every = end, .history_every = end, .gauge_every = end};
    scene_.gauges.clear();
    scene_.contact = {};
}

Scene parse_case(const std::string& text, const std::filesystem::path& file,
                 const std::vector<std::string>& overrides)
{
    Reading reading{.file = file, .lines = lines_to_show(text), .overrides = overrides};
    const TomlNode document = parse_document(text, reading);
    TableReader root(reading, &document, "", "");
    Scene scene;
    scene.file = file;
    scene.overrides = overrides;
    keys_of(root, scene);
    root.finish();
    if (!reading.diagnostics.empty() && std::ranges::all_of(reading.diagnostics, leaves_the_rest)) {
        throw PlacedCaseError(CaseError(reading.diagnostics), std::move(scene));
    }
    throw_if_any(reading);
    scene.notices = std::move(reading.notices);
    return scene;
}

Scene read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides)
{
    const std::string why = why_unreadable(file, largest_text);
    if (!why.empty()) {
        const bool folder = why.starts_with("is a folder");
        throw CaseError({Diagnostic{.file = file.string(),
                                    .what = "the case file " + why,
                                    .hint = folder ? "name the .toml file in it"
                                                   : "`hyoryu new` writes a case to start from"}});
    }
    return parse_case(bytes_of_file(file), file, overrides);
}

Diagnostic diagnostic_without_line(const Scene& scene, const Place& place, std::string key,
                                   std::string what, std::string hint)
{
    Reading reading{.file = scene.file};
    reading.error(place, -1, std::move(key), std::move(what), std::move(hint));
    return reading.diagnostics.front();
}

void show_places(const Scene& scene, std::vector<Diagnostic>& diagnostics)
{
    if (diagnostics.empty() || !why_unreadable(scene.file, largest_text).empty()) {
        return;
    }
    const std::string text = bytes_of_file(scene.file);
    Reading reading{.file = scene.file, .lines = lines_to_show(text), .overrides = scene.overrides};
    const TomlNode document = document_again(text, scene.overrides);
    TablesByPlace tables;
    list_tables(document, tables);
    for (Diagnostic& diagnostic : diagnostics) {
        if (diagnostic.file != scene.file.string()) {
            continue; // of an override, which it names already
        }
        const Place place{diagnostic.line, diagnostic.column, diagnostic.length};
        const auto table = tables.find({place.line, place.column});
        const std::string key = diagnostic.key;
        const TomlNode* value = nullptr;
        if (place.line == 0 && !key.empty()) {
            value = find_value(&document, key);
        }
        // Of "wall[1].motion.piston.height" the most that the table of the wall has.
        for (std::size_t dot = key.find('.');
             table != tables.end() && value == nullptr && dot != std::string::npos;
             dot = key.find('.', dot + 1)) {
            value = find_value(table->second, key.substr(dot + 1));
        }
        if (value != nullptr) {
            reading.error(*value, key, diagnostic.what, diagnostic.hint);
        } else {
            reading.error(place, -1, key, diagnostic.what, diagnostic.hint);
        }
        reading.diagnostics.back().severity = diagnostic.severity;
        diagnostic = std::move(reading.diagnostics.back());
        reading.diagnostics.pop_back();
    }
}

Diagnostic diagnostic_at(const Scene& scene, const Place& place, std::string key, std::string what,
                         std::string hint)
{
    std::vector<Diagnostic> one{
        diagnostic_without_line(scene, place, std::move(key), std::move(what), std::move(hint))};
    show_places(scene, one);
    return one.front();
}

} // namespace hyoryu
