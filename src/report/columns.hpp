// SPDX-License-Identifier: MIT
// Columns of a history that must be there.
#pragma once

#include "hyoryu/io/csv_table.hpp"

#include <string>
#include <vector>

namespace hyoryu {

/// The numbers of a column; `file` is for messages. Throws IoError if the table lacks it or a cell
/// holds no number.
const std::vector<double>& numbers_of(const CsvTable& table, const std::string& column,
                                      const std::string& file);
/// The cells as texts, also where every one of them reads as a number. Throws IoError if the table
/// lacks the column.
std::vector<std::string> texts_of(const CsvTable& table, const std::string& column,
                                  const std::string& file);

} // namespace hyoryu
