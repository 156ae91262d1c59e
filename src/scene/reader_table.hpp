// SPDX-License-Identifier: MIT
// Reading a table of the case file by the table of keys: every value is checked for type, unit and
// bounds when it is asked for, every mistake is noted with its place, and nothing is left unread.
#pragma once

#include "hyoryu/scene/toml_document.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/parameter.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyoryu {

/// What the parts of the reader share.
struct Reading {
    std::filesystem::path file;
    std::vector<std::string> lines;
    std::vector<std::string> overrides;
    int dimensions = 3;
    std::vector<Diagnostic> diagnostics;
    std::map<std::string, int> names; // of walls and bodies, and the line where each stands

    /// Notes a mistake at a place of the file, or of that override.
    void error(const Place& place, int override_number, std::string key, std::string what,
               std::string hint = {});
    /// The same at a value.
    void error(const TomlNode& node, std::string key, std::string what, std::string hint = {});
};

/// One table of the file, or its absence, which gives the defaults.
class TableReader {
public:
    /// `path` is where the table stands ("body[2]"), `schema` its name in the table of keys
    /// ("body[]").
    TableReader(Reading& reading, const TomlNode* node, std::string path, std::string schema);

    bool present() const { return node_ != nullptr; }
    bool has(std::string_view key) const;
    Place place() const { return node_ != nullptr ? node_->place : Place{}; }
    const std::string& path() const { return path_; }
    Reading& reading() const { return reading_; }

    // The value of a key, else its default; nothing if it has neither or is mistaken.
    std::optional<double> find_number(std::string_view key);
    std::optional<Vec3> find_vector(std::string_view key);

    // The same where nothing else can be done than to go on with zeros until the mistakes are told.
    double number(std::string_view key) { return find_number(key).value_or(0); }
    Vec3 vector(std::string_view key) { return find_vector(key).value_or(Vec3(0, 0, 0)); }
    std::int64_t integer(std::string_view key);
    bool flag(std::string_view key);
    std::string text(std::string_view key);
    /// One of the choices; empty if mistaken: then keys that belong to a choice are not judged.
    std::string choice(std::string_view key);
    std::vector<double> numbers(std::string_view key);
    std::vector<Vec3> vectors(std::string_view key);
    std::vector<std::int64_t> integers(std::string_view key);
    std::vector<std::string> texts(std::string_view key);

    /// A vector in space: its y is zero in two dimensions.
    std::optional<Vec3> find_planar(std::string_view key);
    Vec3 planar(std::string_view key) { return find_planar(key).value_or(Vec3(0, 0, 0)); }
    /// The unit vector along it; a mistake if it has no direction.
    std::optional<Vec3> find_direction(std::string_view key);

    TableReader table(std::string_view key);
    std::vector<TableReader> tables(std::string_view key);

    /// Notes a mistake at the value of a key, or at the table if the key is not there.
    void error(std::string_view key, std::string what, std::string hint = {});
    /// The same at an element of a list.
    void error_at(std::string_view key, std::size_t index, std::string what, std::string hint = {});
    /// A key that must be there in this case although not in every one.
    void require(std::string_view key);
    /// No key of this table is judged as meaningless any more; for after a mistake.
    void abandon() { abandoned_ = true; }

    /// Notes every key that is unknown or that nothing asked for. The last call.
    void finish();

private:
    const Parameter& parameter(std::string_view key) const;
    const TomlNode* ask(std::string_view key);
    const TomlArray* ask_list(std::string_view key, std::string_view elements);
    std::string full(std::string_view key) const;
    std::optional<double> to_number(const TomlNode& node, const Parameter& rule,
                                    const std::string& key);
    std::optional<std::int64_t> to_integer(const TomlNode& node, const Parameter& rule,
                                           const std::string& key);
    bool is_choice(const TomlNode& node, const std::string& value, const Parameter& rule,
                   const std::string& key);
    void report_unknown(const TomlEntry& entry);
    void report_unused(const TomlEntry& entry);

    Reading& reading_;
    const TomlNode* node_;
    std::string path_;
    std::string schema_;
    std::vector<std::string> asked_;
    std::string chosen_; // `shape = "box"`: why other keys have no meaning
    bool abandoned_ = false;
};

} // namespace hyoryu
