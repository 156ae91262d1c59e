// SPDX-License-Identifier: MIT
#include "number_table.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>

namespace hyoryu {

namespace {

constexpr std::size_t most_faults = 5;
constexpr std::string_view separators = " \t\r,;";

std::vector<std::string_view> words_of(std::string_view line)
{
    std::vector<std::string_view> words;
    while (true) {
        const auto first = line.find_first_not_of(separators);
        if (first == std::string_view::npos) {
            return words;
        }
        line.remove_prefix(first);
        const auto length = std::min(line.find_first_of(separators), line.size());
        words.push_back(line.substr(0, length));
        line.remove_prefix(length);
    }
}

std::optional<double> number_of(std::string_view word)
{
    double value = 0;
    word.remove_prefix(word.starts_with('+') ? 1 : 0);
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool whole = fault == std::errc() && end == word.data() + word.size();
    return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

// The numbers of a line, or what is wrong with it.
std::string parse_row(const std::vector<std::string_view>& words, std::size_t columns,
                      std::vector<double>& row)
{
    for (const std::string_view word : words) {
        const auto value = number_of(word);
        if (!value) {
            return fmt::format("expected a number, found \"{}\"", word);
        }
        row.push_back(*value);
    }
    return row.size() == columns
               ? std::string()
               : fmt::format("expected {} numbers, found {}", columns, row.size());
}

} // namespace

NumberTable read_number_table(const std::filesystem::path& file, std::size_t columns)
{
    NumberTable table;
    std::ifstream stream(file);
    if (!stream || std::filesystem::is_directory(file)) {
        table.faults.push_back(fmt::format("{}: cannot be read", file.string()));
        return table;
    }
    std::string line;
    bool header_allowed = true;
    for (int number = 1; std::getline(stream, line); ++number) {
        const std::vector<std::string_view> words = words_of(line);
        if (words.empty() || words.front().starts_with('#')) {
            continue;
        }
        const bool header = header_allowed && !number_of(words.front());
        header_allowed = false;
        if (header) {
            continue;
        }
        std::vector<double> row;
        const std::string fault = parse_row(words, columns, row);
        if (fault.empty()) {
            table.rows.push_back(std::move(row));
            table.lines.push_back(number);
        } else if (table.faults.size() < most_faults) {
            table.faults.push_back(fmt::format("{}:{}: {}", file.string(), number, fault));
        }
    }
    return table;
}

} // namespace hyoryu
