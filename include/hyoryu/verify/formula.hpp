// SPDX-License-Identifier: MIT
// Arithmetic expressions of benchmark files, evaluated with numbers or with the columns of a table.
#pragma once

#include "hyoryu/io/csv_table.hpp"

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace hyoryu {

/// An expression that cannot be read or evaluated; the text says why and names what is known.
struct FormulaError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// One expression: + - * / ^, comparisons, && ||, a ? b : c, sqrt, abs, min, max, exp, ln, the
/// trigonometric functions in radians, atan2(y, x), floor, rad(degrees), and the number _pi (the
/// syntax of muParser).
class Formula {
public:
    /// Throws FormulaError on a syntax error.
    explicit Formula(const std::string& text);
    ~Formula();
    Formula(Formula&&) noexcept;
    Formula& operator=(Formula&&) noexcept;

    /// The names it uses, in the order of `value`'s numbers.
    const std::vector<std::string>& names() const;
    double value(const std::vector<double>& numbers) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// What a name in an expression may stand for, beside the columns of a table.
struct Scope {
    std::map<std::string, double> numbers;      // constants, and the parameters of the run
    std::map<std::string, std::string> columns; // derived columns: expressions of other columns
};

/// The number that an expression of numbers gives. Throws FormulaError.
double evaluate(const std::string& text, const Scope& scope);

/// One value a row of the table; `t` stands for the column `time`. Numbers hide columns, and
/// columns of the table hide derived ones. Throws FormulaError, also for a column of texts.
std::vector<double> evaluate(const std::string& text, const Scope& scope, const CsvTable& table);

} // namespace hyoryu
