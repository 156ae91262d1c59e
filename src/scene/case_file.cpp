// SPDX-License-Identifier: MIT
#include "hyoryu/scene/case_file.hpp"

#include "hyoryu/core/input_file.hpp"

#include "keys_scene.hpp"

#include <fmt/format.h>

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

// The document of a case that was read, or an empty one if its file has changed beyond reading.
TomlNode document_again(const std::string& text, const std::vector<std::string>& overrides)
{
    try {
        Reading reading{.lines = {}, .overrides = overrides};
        return parse_document(text, reading);
    } catch (const CaseError&) {
        return {};
    }
}

const TomlNode* table_at(const TomlNode& node, const Place& place)
{
    const auto is_there = [&](const TomlNode& inner) {
        return inner.place.line == place.line && inner.place.column == place.column;
    };
    const TomlNode* found = nullptr;
    if (const TomlArray* items = node.array()) {
        for (std::size_t k = 0; k < items->size() && found == nullptr; ++k) {
            found = table_at((*items)[k], place);
        }
    } else if (const TomlTable* entries = node.table()) {
        for (std::size_t k = 0; k < entries->size() && found == nullptr; ++k) {
            found = table_at((*entries)[k].node, place);
        }
    }
    // The root has the place of what comes first in it.
    return found == nullptr && node.table() != nullptr && is_there(node) ? &node : found;
}

// The value of a key in full: in the table at a place, where the last name of the key counts, or
// from the root if there is no place. None if the document does not have it.
const TomlNode* node_of(const TomlNode& root, const Place& place, std::string_view key)
{
    const TomlNode* node = place.line > 0 ? table_at(root, place) : &root;
    std::string_view rest = place.line > 0 ? key.substr(key.rfind('.') + 1) : key;
    while (node != nullptr && !rest.empty()) {
        const std::size_t end = std::min(rest.find('.'), rest.size());
        const TomlTable* table = node->table();
        const TomlEntry* entry =
            table != nullptr ? find_entry(*table, rest.substr(0, end)) : nullptr;
        node = entry != nullptr ? &entry->node : nullptr;
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return node;
}

} // namespace

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

Diagnostic diagnostic_at(const Scene& scene, const Place& place, std::string key, std::string what,
                         std::string hint)
{
    Reading reading{.file = scene.file, .overrides = scene.overrides};
    TomlNode document;
    if (why_unreadable(scene.file, largest_text).empty()) {
        const std::string text = bytes_of_file(scene.file);
        reading.lines = lines_to_show(text);
        document = document_again(text, scene.overrides);
    }
    if (const TomlNode* node = node_of(document, place, key)) {
        reading.error(*node, std::move(key), std::move(what), std::move(hint));
    } else {
        reading.error(place, -1, std::move(key), std::move(what), std::move(hint));
    }
    return reading.diagnostics.front();
}

} // namespace hyoryu
