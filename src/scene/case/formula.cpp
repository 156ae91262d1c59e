// SPDX-License-Identifier: MIT
// Expressions by muParser; the only file that includes it.
#include "hyoryu/scene/formula.hpp"

#include "hyoryu/core/error.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

// muParser takes "0,5" for two expressions, of which the last counts, and "x = 5" for an
// assignment.
void expect_one_value(const std::string& text, int values)
{
    if (values != 1) {
        throw FormulaError(fmt::format("\"{}\" is not one expression but {}, separated by a comma; "
                                       "the decimal sign is a point",
                                       text, values));
    }
    const std::string of_comparisons = "=!<>";
    for (std::size_t k = text.find('='); k != text.npos; k = text.find('=', k + 1)) {
        const bool begun = k > 0 && of_comparisons.find(text[k - 1]) != of_comparisons.npos;
        const bool doubled = k + 1 < text.size() && text[k + 1] == '=';
        if (!begun && !doubled) {
            throw FormulaError(fmt::format("\"{}\" assigns a value; equality is written ==", text));
        }
    }
}

constexpr const char* letters_of_names =
    "0123456789_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

} // namespace

struct Formula::State {
    mu::Parser parser;
    std::vector<std::string> names;
    std::vector<double> values; // where the parser looks for the variables
};

Formula::Formula(const std::string& text) : state_(std::make_unique<State>())
{
    mu::Parser& parser = state_->parser;
    try {
        parser.DefineNameChars(letters_of_names);
        parser.DefineFun(
            "floor", +[](double x) { return std::floor(x); });
        parser.DefineFun(
            "rad", +[](double degrees) { return degrees * std::numbers::pi / 180; });
        parser.SetExpr(text);
        for (const auto& [name, place] : parser.GetUsedVar()) {
            state_->names.push_back(name);
        }
        state_->values.resize(state_->names.size());
        for (std::size_t k = 0; k < state_->names.size(); ++k) {
            parser.DefineVar(state_->names[k], &state_->values[k]);
        }
        int values = 0;
        parser.Eval(values);
        expect_one_value(text, values);
    } catch (const mu::Parser::exception_type& fault) {
        throw FormulaError(fmt::format("\"{}\" is not an expression: {}", text, fault.GetMsg()));
    }
}

Formula::~Formula() = default;
Formula::Formula(Formula&&) noexcept = default;

const std::vector<std::string>& Formula::names() const
{
    return state_->names;
}

double Formula::value(const std::vector<double>& numbers) const
{
    expects(numbers.size() == state_->values.size());
    std::copy(numbers.begin(), numbers.end(), state_->values.begin());
    try {
        return state_->parser.Eval();
    } catch (const mu::Parser::exception_type& fault) {
        throw FormulaError(fault.GetMsg());
    }
}

} // namespace hyoryu
