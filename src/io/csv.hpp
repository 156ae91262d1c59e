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
/// Calls f(k, cell) for the cells of one line, without the quotes.
void for_each_csv_cell(std::string_view line, auto&& f)
{
    if (line.find('"') != std::string_view::npos) {
        const std::vector<std::string> cells = csv_cells(line);
        for (std::size_t k = 0; k < cells.size(); ++k) {
            f(k, std::string_view(cells[k]));
        }
        return;
    }
    for (std::size_t k = 0;; ++k) {
        const std::size_t end = line.find(',');
        f(k, line.substr(0, end));
        if (end == std::string_view::npos) {
            return;
        }
        line.remove_prefix(end + 1);
    }
}
/// Cells joined to a line with its end; the cells are quoted already where they must be.
std::string csv_line(std::span<const std::string> cells);
/// The number a whole cell holds; "nan" and "inf" are numbers.
std::optional<double> csv_number(std::string_view cell);

/// The lines that end in a line break: a torn last line is none.
std::vector<std::string_view> whole_lines(std::string_view text);

/// The units and the header row of a history.
std::string csv_header(const Table& table);

} // namespace hyoryu
