// SPDX-License-Identifier: MIT
#include "hyoryu/io/csv_table.hpp"

#include "csv.hpp"
#include "hyoryu/core/error.hpp"

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

} // namespace

const CsvTable::Column* CsvTable::find(std::string_view name) const
{
    const auto at = std::find_if(columns.begin(), columns.end(),
                                 [name](const Column& column) { return column.name == name; });
    return at == columns.end() ? nullptr : &*at;
}

CsvTable read_csv(const std::filesystem::path& file)
{
    const std::string text = file_text(file);
    CsvTable table;
    for (const std::string_view line : whole_lines(text)) {
        if (line.starts_with('#') || line.empty()) {
            continue;
        }
        std::vector<std::string> cells = csv_cells(line);
        if (table.columns.empty()) {
            for (std::string& name : cells) {
                table.columns.push_back({std::move(name), {}, {}});
            }
            continue;
        }
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
        throw IoError(fmt::format("`{}` names no columns", file.string()));
    }
    return table;
}

} // namespace hyoryu
