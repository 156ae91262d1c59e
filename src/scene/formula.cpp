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

double floor_of(double x)
{
    return std::floor(x);
}

double radians(double degrees)
{
    return degrees * std::numbers::pi / 180;
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
        parser.DefineFun("floor", floor_of);
        parser.DefineFun("rad", radians);
        parser.SetExpr(text);
        for (const auto& [name, place] : parser.GetUsedVar()) {
            state_->names.push_back(name);
        }
        state_->values.resize(state_->names.size());
        for (std::size_t k = 0; k < state_->names.size(); ++k) {
            parser.DefineVar(state_->names[k], &state_->values[k]);
        }
        parser.Eval();
    } catch (const mu::Parser::exception_type& fault) {
        throw FormulaError(fmt::format("\"{}\" is not an expression: {}", text, fault.GetMsg()));
    }
}

Formula::~Formula() = default;
Formula::Formula(Formula&&) noexcept = default;
Formula& Formula::operator=(Formula&&) noexcept = default;

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
