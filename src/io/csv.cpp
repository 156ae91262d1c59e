// SPDX-License-Identifier: MIT
// Splitting and joining CSV lines (RFC 4180 quotes; a cell never holds a line break).
#include "csv.hpp"

#include "atomic_file.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/core/name.hpp"
#include "hyoryu/io/results.hpp"

#include <array>
#include <charconv>
#include <span>
#include <utility>

namespace hyoryu {

std::string cell(double value)
{
    std::array<char, 32> text{}; // the longest double takes 24 characters
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

std::string cell(std::string_view text)
{
    if (text.find_first_of(",\"#\r\n") == std::string_view::npos) {
        return std::string(text);
    }
    return '"' + replaced(text, {{'"', "\"\""}, {'\n', " "}, {'\r', " "}}) + '"';
}

std::vector<std::string> csv_cells(std::string_view line)
{
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const bool doubled = quoted && line.substr(i).starts_with("\"\"");
        if (line[i] == '"' && !doubled) {
            quoted = !quoted;
        } else if (line[i] == ',' && !quoted) {
            cells.emplace_back();
        } else {
            cells.back() += line[i];
            i += doubled ? 1 : 0;
        }
    }
    return cells;
}

std::string csv_line(std::span<const std::string> cells)
{
    expects(!cells.empty());
    std::string line;
    for (const std::string& text : cells) {
        line += text;
        line += ',';
    }
    line.back() = '\n';
    return line;
}

std::optional<double> csv_number(std::string_view text)
{
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const bool whole = error == std::errc{} && stop == end;
    return whole ? std::optional(value) : std::nullopt;
}

std::vector<std::string_view> whole_lines(std::string_view text)
{
    std::vector<std::string_view> lines;
    std::size_t begin = 0;
    for (std::size_t end = text.find('\n'); end != std::string_view::npos;
         end = text.find('\n', begin)) {
        lines.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return lines;
}

std::string csv_header(const Table& table)
{
    std::vector<std::string> units;
    std::vector<std::string> names;
    for (const Table::Head& head : table.heads) {
        units.push_back(head.unit.empty() ? "-" : head.unit);
        names.push_back(cell(head.name));
    }
    return "# " + csv_line(units) + csv_line(names);
}

} // namespace hyoryu
