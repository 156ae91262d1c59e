// SPDX-License-Identifier: MIT
// What files of benchmarks and of studies have in common.
#pragma once

#include "hyoryu/assess/benchmark.hpp"
#include "hyoryu/assess/section.hpp"

#include <filesystem>
#include <optional>
#include <string_view>

namespace hyoryu {

/// A file with its lines, and its text as TOML. Throws CaseError if it cannot be read or parsed.
struct OpenedFile {
    BenchmarkFile file;
    TomlNode document;
};
OpenedFile open_toml(const std::filesystem::path& file);

/// `[constants]`: numbers, or expressions of those before them. `[columns]`: derived columns.
Constants read_constants(Section& root);
std::map<std::string, std::string> read_columns(Section& root);

/// A number or a text as a parameter; nothing for anything else.
std::optional<RunParameter> parameter_of(const TomlNode& node);

/// Which rows of which file, and the expression `key` of their columns.
Series read_series(Section& section, std::string_view key);

/// What is measured: series, `measure` and what that measure needs.
Quantity read_quantity(Section& section);

/// Whether the measure is the difference from something expected.
bool is_error_measure(Measure measure);

} // namespace hyoryu
