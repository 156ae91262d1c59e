// SPDX-License-Identifier: MIT
// Lines of text files with rows of numbers.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyoryu {

/// A line of a table, split at commas, semicolons and blanks.
struct TableLine {
    int number = 0;
    std::vector<std::string> words;
    bool mixed = false; // has commas and semicolons: its commas may be decimal
};

/// What is wrong with a line that is `mixed`.
inline constexpr std::string_view mixed_separators =
    "commas and semicolons in one line, expected one of them as separator and a decimal point in "
    "each number";

/// The lines of a file but for empty ones and those that begin with #. The byte order mark, with
/// which Excel begins a CSV file, is passed over.
std::vector<TableLine> table_lines(const std::filesystem::path& file);

/// The finite number that a word is.
std::optional<double> table_number(std::string_view word);

} // namespace hyoryu
