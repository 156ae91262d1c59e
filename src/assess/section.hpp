// SPDX-License-Identifier: MIT
// Reading one table of a benchmark or study file: every mistake is noted with its place.
#pragma once

#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/toml_document.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyoryu {

/// The file, its lines for the messages, and its mistakes.
struct BenchmarkFile {
    std::filesystem::path file;
    std::vector<std::string> lines;
    std::vector<Diagnostic> mistakes;

    void error(const Place& place, std::string key, std::string what, std::string hint = {});
    /// Throws CaseError with all of them if there are any.
    void expect_no_mistakes() const;
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
    /// The index of the text among the names; none if it is absent, which is not a mistake.
    std::optional<std::size_t> choice(std::string_view key,
                                      std::span<const std::string_view> names);
    /// A number, or a text that is an expression (its syntax is checked); empty if not there.
    std::string expression(std::string_view key);
    /// The sub-table and the elements of a list of tables; none if not there.
    std::optional<Section> table(std::string_view key);
    std::vector<Section> tables(std::string_view key);
    /// The elements of a list of anything.
    std::vector<const TomlNode*> items(std::string_view key, std::string_view expected = "a list");
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
    template <class T>
    T value(std::string_view key, T fallback, std::string_view expected);
    template <class T>
    std::vector<T> list(std::string_view key, std::string_view expected);

    BenchmarkFile* file_;
    TomlNode node_;
    std::string path_;
    std::vector<std::string> asked_;
};

/// The value of a node as a text, a whole number or a number (also if it is whole); none for any
/// other type.
template <class T>
std::optional<T> value_in(const TomlNode& node)
{
    if constexpr (std::is_same_v<T, double>) {
        if (const auto* integer = std::get_if<std::int64_t>(&node.value)) {
            return static_cast<double>(*integer);
        }
    }
    const auto* value = std::get_if<T>(&node.value);
    return value != nullptr ? std::optional<T>(*value) : std::nullopt;
}

/// The text of a number or of a text; nothing for anything else.
std::optional<std::string> scalar_text(const TomlNode& node);

/// The same with its syntax checked; mistakes are noted under `key`.
std::string checked_expression(BenchmarkFile& file, const TomlNode& node, const std::string& key);

} // namespace hyoryu
