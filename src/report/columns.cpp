// SPDX-License-Identifier: MIT
#include "columns.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/io/results.hpp"

#include <fmt/format.h>

namespace hyoryu {

namespace {

const CsvTable::Column& column_of(const CsvTable& table, const std::string& column,
                                  const std::string& file)
{
    const CsvTable::Column* found = table.find(column);
    if (found == nullptr) {
        throw IoError(fmt::format("`{}` has no column `{}`", file, column));
    }
    return *found;
}

} // namespace

const std::vector<double>& numbers_of(const CsvTable& table, const std::string& column,
                                      const std::string& file)
{
    const CsvTable::Column& found = column_of(table, column, file);
    if (!found.texts.empty()) {
        throw IoError(
            fmt::format("`{}`: column `{}` holds something else than numbers", file, column));
    }
    return found.numbers;
}

std::vector<std::string> texts_of(const CsvTable& table, const std::string& column,
                                  const std::string& file)
{
    const CsvTable::Column& found = column_of(table, column, file);
    std::vector<std::string> texts = found.texts;
    texts.resize(table.rows);
    for (std::size_t row = 0; row < table.rows; ++row) {
        // Rows before the first text keep only their number.
        texts[row] = texts[row].empty() ? cell(found.numbers[row]) : texts[row];
    }
    return texts;
}

} // namespace hyoryu
