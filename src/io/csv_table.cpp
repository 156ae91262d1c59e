// SPDX-License-Identifier: MIT
#include "hyoryu/io/csv_table.hpp"

#include "csv.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/core/input_file.hpp"
#include "hyoryu/io/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace hyoryu {

namespace {

void append(CsvTable::Column& column, std::string text, std::size_t rows)
{
    const std::optional<double> number = csv_number(text);
    if (!number && column.texts.empty()) {
        // Until here every cell was a number; texts of numbers are not asked for.
        column.texts.resize(rows);
    }
    column.numbers.push_back(number.value_or(std::numeric_limits<double>::quiet_NaN()));
    if (!number || !column.texts.empty()) {
        column.texts.push_back(std::move(text));
    }
}

/// Columns of the header row; `before` is the line above it.
std::vector<CsvTable::Column> named_columns(std::string_view header, std::string_view before)
{
    std::vector<CsvTable::Column> columns;
    for (std::string& name : csv_cells(header)) {
        columns.push_back({.name = std::move(name)});
    }
    if (before.starts_with("# ")) {
        const std::vector<std::string> units = csv_cells(before.substr(2));
        for (std::size_t k = 0; units.size() == columns.size() && k < units.size(); ++k) {
            columns[k].unit = units[k] == "-" ? "" : units[k];
        }
    }
    return columns;
}

const CsvTable::Column& column_of(const CsvTable& table, std::string_view column)
{
    const CsvTable::Column* found = table.find(column);
    if (found == nullptr) {
        throw IoError(fmt::format("`{}` has no column `{}`", table.file.string(), column));
    }
    return *found;
}

} // namespace

const CsvTable::Column* CsvTable::find(std::string_view name) const
{
    const auto at = std::ranges::find(columns, name, &Column::name);
    return at == columns.end() ? nullptr : &*at;
}

const std::vector<double>& numbers_of(const CsvTable& table, std::string_view column)
{
    const CsvTable::Column& found = column_of(table, column);
    if (!found.texts.empty()) {
        throw IoError(fmt::format("`{}`: column `{}` contains values that are not numbers",
                                  table.file.string(), column));
    }
    return found.numbers;
}

std::vector<std::string> texts_of(const CsvTable& table, std::string_view column)
{
    const CsvTable::Column& found = column_of(table, column);
    std::vector<std::string> texts = found.texts;
    texts.resize(table.rows);
    for (std::size_t row = 0; row < table.rows; ++row) {
        // Rows before the first text keep only their number.
        texts[row] = texts[row].empty() ? cell(found.numbers[row]) : texts[row];
    }
    return texts;
}

CsvTable read_csv(const std::filesystem::path& file)
{
    const std::string text = bytes_of_file(file);
    CsvTable table{.file = file};
    std::string_view before;
    for (const std::string_view line : whole_lines(text)) {
        if (line.starts_with('#') || line.empty()) {
            before = line;
            continue;
        }
        if (table.columns.empty()) {
            table.columns = named_columns(line, before);
            continue;
        }
        std::vector<std::string> cells = csv_cells(line);
        if (cells.size() != table.columns.size()) {
            throw IoError(fmt::format("`{}`: a row of {} cells, expected {}: {}", file.string(),
                                      cells.size(), table.columns.size(), line));
        }
        for (std::size_t k = 0; k < cells.size(); ++k) {
            append(table.columns[k], std::move(cells[k]), table.rows);
        }
        table.rows += 1;
    }
    if (table.columns.empty()) {
        throw IoError(fmt::format("`{}` has no header with column names", file.string()));
    }
    return table;
}

} // namespace hyoryu
