// SPDX-License-Identifier: MIT
// CSV tables as histories keep them: a `#` line of units, a header row, rows.
#pragma once

#include "hyoryu/core/snapshot.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyoryu {

/// The cells of one line, without the quotes.
std::vector<std::string> csv_cells(std::string_view line);
/// Cells joined to a line with its end; the cells are quoted already where they must be.
std::string csv_line(std::span<const std::string> cells);
/// The number a whole cell holds; "nan" and "inf" are numbers.
std::optional<double> csv_number(std::string_view cell);

/// The whole file; throws IoError.
std::string file_text(const std::filesystem::path& file);
/// The lines that end in a line break: a torn last line is none.
std::vector<std::string_view> whole_lines(std::string_view text);

/// The units and the header row of a history.
std::string csv_header(const Table& table);

} // namespace hyoryu
