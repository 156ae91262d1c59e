// SPDX-License-Identifier: MIT
// Reading one table of a benchmark file: every mistake is noted with its place.
#pragma once

#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/toml_document.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyoryu {

/// The file, its lines for the messages, and what is wrong with it.
struct BenchmarkFile {
    std::filesystem::path file;
    std::vector<std::string> lines;
    std::vector<Diagnostic> mistakes;

    void error(const Place& place, std::string key, std::string what, std::string hint = {});
};

class Section {
public:
    /// `path` is where the table stands ("check[2]"). A node that is no table is noted as a mistake
    /// and read as an empty one.
    Section(BenchmarkFile& file, const TomlNode& node, std::string path);

    bool has(std::string_view key) const;
    Place place() const { return node_.place; }
    Place place_of(std::string_view key) const;

    std::string text(std::string_view key, std::string fallback = {});
    /// A text that tables, pictures and the terminal show (see `label_fault`).
    std::string label(std::string_view key, std::string fallback = {});
    double number(std::string_view key, double fallback);
    std::int64_t integer(std::string_view key, std::int64_t fallback);
    std::vector<std::string> texts(std::string_view key);
    std::vector<double> numbers(std::string_view key);
    /// A number, or a text that is an expression (its syntax is checked); empty if not there.
    std::string expression(std::string_view key);
    /// The sub-table and the elements of a list of tables; none if not there.
    std::optional<Section> table(std::string_view key);
    std::vector<Section> tables(std::string_view key);
    /// The elements of a list of anything.
    std::vector<const TomlNode*> items(std::string_view key);
    /// The entries of a table whose keys are free, in the order of the file.
    std::vector<const TomlEntry*> entries(std::string_view key);

    void require(std::string_view key);
    void error(std::string_view key, std::string what, std::string hint = {});
    /// Notes every key that nothing asked for. The last call.
    void finish();

    std::string full(std::string_view key) const;
    BenchmarkFile& file() { return *file_; }

private:
    const TomlEntry* ask(std::string_view key);
    void mistyped(const TomlEntry& entry, std::string_view expected);

    BenchmarkFile* file_;
    TomlNode node_;
    std::string path_;
    std::vector<std::string> asked_;
};

/// The text of a number or of a text; nothing for anything else.
std::optional<std::string> scalar_text(const TomlNode& node);

/// The same with its syntax checked; mistakes are noted under `key`.
std::string checked_expression(BenchmarkFile& file, const TomlNode& node, const std::string& key);

} // namespace hyoryu
