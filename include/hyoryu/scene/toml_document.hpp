// SPDX-License-Identifier: MIT
// A TOML file as a tree of values that know their places. Keeps the parser library in one file.
#pragma once

#include "hyoryu/scene/scene.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hyoryu {

struct TomlNode;
struct TomlEntry;
struct TomlDate {
    bool operator==(const TomlDate&) const = default;
};
using TomlArray = std::vector<TomlNode>;
using TomlTable = std::vector<TomlEntry>;

/// One value.
struct TomlNode {
    std::variant<std::string, std::int64_t, double, bool, TomlDate, TomlArray, TomlTable> value;
    Place place;
    int override_number = -1; // which override it came from; -1: the file

    const TomlTable* table() const { return std::get_if<TomlTable>(&value); }
    TomlTable* table() { return std::get_if<TomlTable>(&value); }
    const TomlArray* array() const { return std::get_if<TomlArray>(&value); }
    TomlArray* array() { return std::get_if<TomlArray>(&value); }
};

/// A key of a table and its value.
struct TomlEntry {
    std::string key;
    Place place; // of the key
    TomlNode node;
};

/// By keys and values, wherever they stand; any two dates are equal.
bool operator==(const TomlNode& a, const TomlNode& b);
bool operator==(const TomlEntry& a, const TomlEntry& b);

/// A syntax error.
struct TomlFault {
    Place place;
    std::string what;
    std::string hint = {}; // how to mend it; may be empty
};

/// The entry with that key, or none.
const TomlEntry* find_entry(const TomlTable& table, std::string_view key);
TomlEntry* find_entry(TomlTable& table, std::string_view key);

/// Reads a text; the root is a table. Throws TomlFault at the first syntax error.
TomlNode parse_toml(std::string_view text);

/// The lines of a text as messages show them: without control characters, which would shift the
/// caret; a line that is longer than a screen is empty.
std::vector<std::string> lines_to_show(const std::string& text);

/// "the number 3", "the text \"abc\"", "a table": the description of a value for messages.
std::string found(const TomlNode& node);

/// Applies `key.path=VALUE` to the tree: replaces the value or adds it, with the tables on the way.
/// Returns the fault of the override; empty if there is none.
std::string apply_override(TomlNode& root, std::string_view text, int number);

} // namespace hyoryu
