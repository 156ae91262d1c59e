// SPDX-License-Identifier: MIT
// Arithmetic expressions of benchmark files, evaluated with numbers or with the columns of a table.
#pragma once

#include "hyoryu/io/csv_table.hpp"
#include "hyoryu/scene/formula.hpp"

#include <map>
#include <string>
#include <vector>

namespace hyoryu {

/// The meaning of a name in an expression, other than the columns of a table.
struct Scope {
    std::map<std::string, double> numbers;      // constants, and the parameters of the run
    std::map<std::string, std::string> columns; // derived columns: expressions of other columns
};

/// The number that an expression of numbers gives. Throws FormulaError.
double evaluate(const std::string& text, const Scope& scope);

/// One value for each of some rows of the table; `t` stands for the column `time`. Numbers hide
/// columns, and columns of the table hide derived ones. Throws FormulaError, also for a column of
/// texts.
std::vector<double> evaluate(const std::string& text, const Scope& scope, const CsvTable& table,
                             const std::vector<std::size_t>& rows);
/// Of all rows.
std::vector<double> evaluate(const std::string& text, const Scope& scope, const CsvTable& table);

} // namespace hyoryu
