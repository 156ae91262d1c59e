// SPDX-License-Identifier: MIT
// Expressions with the names of constants and columns.
#include "hyoryu/assess/formula.hpp"

#include "hyoryu/scene/reader_hint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>

namespace hyoryu {

namespace {

[[noreturn]] void refuse_name(const std::string& name, const Scope& scope, const CsvTable* table)
{
    std::vector<std::string_view> known;
    for (const auto& [number, value] : scope.numbers) {
        known.push_back(number);
    }
    if (table != nullptr) {
        for (const CsvTable::Column& column : table->columns) {
            known.push_back(column.name);
        }
        for (const auto& [column, text] : scope.columns) {
            known.push_back(column);
        }
    }
    if (known.empty()) {
        throw FormulaError(fmt::format("unknown name \"{}\"; no names are defined", name));
    }
    const std::string near = did_you_mean(name, known);
    throw FormulaError(fmt::format("unknown name \"{}\"; {}", name,
                                   near.empty() ? "known: " + quoted_list(known) : near));
}

/// Columns evaluated so far; a deque, because the addresses of its elements stay.
class Columns {
public:
    Columns(const Scope& scope, const CsvTable& table, const std::vector<std::size_t>& rows)
        : scope_(scope), table_(table), rows_(rows)
    {
    }

    std::vector<double> of(const std::string& text)
    {
        constexpr int deepest = 32;
        if (++depth_ > deepest) {
            throw FormulaError(fmt::format("the column \"{}\" is defined by itself", text));
        }
        const Formula formula(text);
        std::vector<const std::vector<double>*> sources;
        std::vector<double> numbers(formula.names().size());
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            const auto number = scope_.numbers.find(formula.names()[k]);
            const bool constant = number != scope_.numbers.end();
            numbers[k] = constant ? number->second : 0;
            sources.push_back(constant ? nullptr : &named(formula.names()[k]));
        }
        std::vector<double> values(rows_.size());
        for (std::size_t row = 0; row < values.size(); ++row) {
            for (std::size_t k = 0; k < numbers.size(); ++k) {
                numbers[k] = sources[k] != nullptr ? (*sources[k])[row] : numbers[k];
            }
            values[row] = formula.value(numbers);
        }
        --depth_;
        return values;
    }

private:
    const std::vector<double>& named(const std::string& name)
    {
        if (const auto* column = table_.find(name == "t" ? "time" : name)) {
            std::vector<double>& numbers = columns_.emplace_back();
            for (const std::size_t row : rows_) {
                numbers.push_back(column->numbers[row]);
            }
            const auto is_number = [](double x) { return !std::isnan(x); };
            if (!column->texts.empty() && std::ranges::none_of(numbers, is_number)) {
                throw FormulaError(
                    fmt::format("the column \"{}\" contains text, not numbers", name));
            }
            return numbers;
        }
        const auto derived = scope_.columns.find(name);
        if (derived == scope_.columns.end()) {
            refuse_name(name, scope_, &table_);
        }
        return columns_.emplace_back(of(derived->second));
    }

    const Scope& scope_;
    const CsvTable& table_;
    const std::vector<std::size_t>& rows_;
    std::deque<std::vector<double>> columns_;
    int depth_ = 0;
};

} // namespace

double evaluate(const std::string& text, const Scope& scope)
{
    const Formula formula(text);
    std::vector<double> numbers;
    for (const std::string& name : formula.names()) {
        const auto at = scope.numbers.find(name);
        if (at == scope.numbers.end()) {
            refuse_name(name, scope, nullptr);
        }
        numbers.push_back(at->second);
    }
    return formula.value(numbers);
}

std::vector<double> evaluate(const std::string& text, const Scope& scope, const CsvTable& table,
                             const std::vector<std::size_t>& rows)
{
    return Columns(scope, table, rows).of(text);
}

std::vector<double> evaluate(const std::string& text, const Scope& scope, const CsvTable& table)
{
    std::vector<std::size_t> rows(table.rows);
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    return evaluate(text, scope, table, rows);
}

} // namespace hyoryu
