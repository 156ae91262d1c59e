// SPDX-License-Identifier: MIT
// A CSV table read back: histories of a run, and reference series from elsewhere.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hyoryu {

/// A table by columns. Lines that begin with `#` (units, sources) are comments. A `#` line right
/// before the names with as many cells gives the units, `-` for none.
struct CsvTable {
    struct Column {
        std::string name;
        std::vector<double> numbers;    // one a row; NaN where the cell holds no number
        std::vector<std::string> texts; // one a row if any cell holds no number, else none
        std::string unit;               // empty if the file does not say
    };
    std::vector<Column> columns;
    std::size_t rows = 0;
    std::filesystem::path file = {}; // where it was read from, for messages

    /// The column of that name, or none.
    const Column* find(std::string_view name) const;
};

/// The numbers of a column. Throws IoError if the table lacks it or a cell holds no number.
const std::vector<double>& numbers_of(const CsvTable& table, std::string_view column);
/// The cells as texts, also where every one of them reads as a number. Throws IoError if the table
/// lacks the column.
std::vector<std::string> texts_of(const CsvTable& table, std::string_view column);

/// Reads a whole file; the first line that is not a comment names the columns. An incomplete last
/// line is ignored. Throws IoError if the file cannot be read, names no columns, or has a row of
/// another length.
CsvTable read_csv(const std::filesystem::path& file);

} // namespace hyoryu
