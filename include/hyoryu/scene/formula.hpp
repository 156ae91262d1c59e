// SPDX-License-Identifier: MIT
// Arithmetic expressions that a user types.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace hyoryu {

/// An expression that cannot be read or evaluated; the text gives the reason and lists the known
/// names.
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

    /// The names it uses, in the order of `value`'s numbers.
    const std::vector<std::string>& names() const;
    double value(const std::vector<double>& numbers) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace hyoryu
