// SPDX-License-Identifier: MIT
#include "table_lines.hpp"

#include <charconv>
#include <cmath>
#include <fstream>

namespace hyoryu {

namespace {

constexpr std::string_view separators = " \t\r,;";
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

} // namespace

std::vector<TableLine> table_lines(const std::filesystem::path& file)
{
    std::vector<TableLine> lines;
    std::ifstream stream(file);
    std::string text;
    for (int number = 1; std::getline(stream, text); ++number) {
        if (number == 1 && text.starts_with(byte_order_mark)) {
            text.erase(0, byte_order_mark.size());
        }
        const bool mixed = text.find(',') != text.npos && text.find(';') != text.npos;
        TableLine line{number, {}, mixed};
        std::size_t from = text.find_first_not_of(separators);
        while (from != text.npos) {
            const std::size_t end = text.find_first_of(separators, from);
            line.words.push_back(text.substr(from, end - from));
            from = text.find_first_not_of(separators, end);
        }
        if (!line.words.empty() && !line.words.front().starts_with('#')) {
            lines.push_back(std::move(line));
        }
    }
    return lines;
}

std::optional<double> table_number(std::string_view word)
{
    double value = 0;
    word.remove_prefix(word.starts_with('+') ? 1 : 0);
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool whole = fault == std::errc() && end == word.data() + word.size();
    return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

} // namespace hyoryu
