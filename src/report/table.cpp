// SPDX-License-Identifier: MIT
#include "hyoryu/report/table.hpp"

#include "hyoryu/core/name.hpp"
#include "hyoryu/report/html.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hyoryu {

namespace {

using Row = std::vector<std::string>;

Row texts_of(const std::vector<TextTable::Head>& heads)
{
    Row texts;
    for (const TextTable::Head& head : heads) {
        texts.push_back(head.text);
    }
    return texts;
}

std::string html_row(const TextTable& table, const Row& cells, std::string_view element)
{
    std::string row;
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const bool right = table.heads[k].align == TextTable::Align::right;
        row += fmt::format("<{0}{1}>{2}</{0}>", element, right ? " class=\"n\"" : "",
                           escaped(cells[k]));
    }
    return row;
}

std::string markdown_row(const Row& cells)
{
    std::string row = "|";
    for (const std::string& text : cells) {
        row += ' ' + replaced(text, {{'|', "\\|"}, {'\n', " "}}) + " |";
    }
    return row + "\n";
}

} // namespace

std::string html_table(const TextTable& table)
{
    std::string text = fmt::format("<table>\n<thead><tr>{}</tr></thead>\n<tbody>\n",
                                   html_row(table, texts_of(table.heads), "th"));
    for (const Row& row : table.rows) {
        text += fmt::format("<tr>{}</tr>\n", html_row(table, row, "td"));
    }
    return text + "</tbody>\n</table>\n";
}

std::string markdown_table(const TextTable& table)
{
    Row rules;
    for (const TextTable::Head& head : table.heads) {
        rules.emplace_back(head.align == TextTable::Align::right ? "---:" : "---");
    }
    std::string text = markdown_row(texts_of(table.heads)) + markdown_row(rules);
    for (const Row& row : table.rows) {
        text += markdown_row(row);
    }
    return text;
}

std::string terminal_table(const TextTable& table)
{
    std::vector<Row> rows{texts_of(table.heads)};
    rows.insert(rows.end(), table.rows.begin(), table.rows.end());
    std::vector<std::size_t> widths(table.heads.size());
    for (const Row& row : rows) {
        for (std::size_t k = 0; k < row.size(); ++k) {
            widths[k] = std::max(widths[k], row[k].size());
        }
    }
    std::string text;
    for (const Row& row : rows) {
        for (std::size_t k = 0; k < row.size(); ++k) {
            text += fmt::format("{:<{}}  ", row[k], widths[k]);
        }
        text += '\n';
    }
    return text;
}

} // namespace hyoryu
