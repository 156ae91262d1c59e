// SPDX-License-Identifier: MIT
#include "number_table.hpp"

#include "hyoryu/core/input_file.hpp"
#include "table_lines.hpp"
#include "units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>

namespace hyoryu {

namespace {

constexpr std::size_t most_faults_of_table = 5;
constexpr std::string_view quotes = "\"'";

using Order = std::vector<std::size_t>; // of each number of a line, the column that it belongs to

std::string names_of(std::span<const NumberColumn> columns)
{
    std::string names;
    for (const NumberColumn& column : columns) {
        names += fmt::format("{}{}", names.empty() ? "" : ", ", column.name);
    }
    return names;
}

// A word of a header: in small letters, without the quotes that programs of tables write.
std::string unquoted(std::string_view word)
{
    std::string text;
    for (const char c : word) {
        if (quotes.find(c) == std::string_view::npos) {
            text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        }
    }
    return text;
}

// Parts "z[m]" into name and unit; a unit may be a word of its own.
std::vector<std::string> names_and_units(const std::vector<std::string>& words)
{
    std::vector<std::string> parts;
    for (const std::string& word : words) {
        const std::string text = unquoted(word);
        const auto bracket = text.find_first_of("[(");
        if (bracket != 0) {
            parts.push_back(text.substr(0, bracket));
        }
        if (bracket != std::string::npos) {
            parts.push_back(
                fmt::format("[{}", text.substr(bracket + 1, text.size() - bracket - 2)));
        }
    }
    return parts;
}

// The fault of the header; empty if it names every column once.
std::string read_header(const std::vector<std::string>& words,
                        std::span<const NumberColumn> columns, Order& order)
{
    order.clear();
    for (const std::string& part : names_and_units(words)) {
        if (part.starts_with('[')) {
            const std::string_view unit = order.empty() ? "" : columns[order.back()].unit;
            if (part.substr(1) != unit) {
                return fmt::format("the header gives the unit \"{}\", expected {}", part.substr(1),
                                   unit);
            }
            continue;
        }
        const auto at =
            std::ranges::find(columns, part == "t" ? "time" : part, &NumberColumn::name);
        const auto column = static_cast<std::size_t>(at - columns.begin());
        if (at == columns.end() || std::ranges::find(order, column) != order.end()) {
            return fmt::format("the header has {} \"{}\", expected the columns {}",
                               at == columns.end() ? "an unknown column" : "a repeated column",
                               part, names_of(columns));
        }
        order.push_back(column);
    }
    return order.size() == columns.size() ? std::string()
                                          : fmt::format("the header names {} columns, expected {}",
                                                        order.size(), names_of(columns));
}

// The numbers of a line, or its fault.
std::string parse_row(const std::vector<std::string>& words, std::span<const NumberColumn> columns,
                      const Order& order, std::vector<double>& row)
{
    if (words.size() != order.size()) {
        return fmt::format("expected {} numbers, found {}", order.size(), words.size());
    }
    row.resize(order.size());
    for (std::size_t k = 0; k < words.size(); ++k) {
        const auto value = table_number(words[k]);
        if (!value) {
            return fmt::format("expected a number, found \"{}\"", words[k]);
        }
        const std::string_view unit = columns[order[k]].unit;
        if (std::abs(*value) > largest_value(unit)) {
            return fmt::format("{} {} is out of range, expected at most {} {}", *value, unit,
                               largest_value(unit), unit);
        }
        row[order[k]] = *value;
    }
    return {};
}

} // namespace

NumberTable read_number_table(const std::filesystem::path& file,
                              std::span<const NumberColumn> columns)
{
    NumberTable table;
    const std::string why = why_unreadable(file, largest_text);
    if (!why.empty()) {
        table.faults.push_back(fmt::format("{}: {}", file.string(), why));
        return table;
    }
    Order order(columns.size()); // as asked for, without a header
    std::iota(order.begin(), order.end(), std::size_t{0});
    bool header_allowed = true;
    for (const TableLine& line : table_lines(file)) {
        const bool header = header_allowed && !table_number(line.words.front());
        header_allowed = false;
        std::vector<double> row;
        const std::string fault = line.mixed ? std::string(mixed_separators)
                                  : header   ? read_header(line.words, columns, order)
                                             : parse_row(line.words, columns, order, row);
        if (!fault.empty() && table.faults.size() < most_faults_of_table) {
            table.faults.push_back(fmt::format("{}:{}: {}", file.string(), line.number, fault));
        }
        if (header && !fault.empty()) {
            return table; // which number is which is not known
        }
        if (!header && fault.empty()) {
            table.rows.push_back(std::move(row));
            table.lines.push_back(line.number);
        }
    }
    return table;
}

} // namespace hyoryu
