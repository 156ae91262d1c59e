// SPDX-License-Identifier: MIT
#include "hyoryu/report/html.hpp"

#include <fmt/format.h>

namespace hyoryu {

namespace {

std::string_view entity(char letter)
{
    switch (letter) {
    case '&':
        return "&amp;";
    case '<':
        return "&lt;";
    case '>':
        return "&gt;";
    case '"':
        return "&quot;";
    case '\'':
        return "&#39;";
    default:
        return {};
    }
}

bool forbidden(char letter)
{
    const auto code = static_cast<unsigned char>(letter);
    return code < 0x20 && letter != '\n' && letter != '\t' && letter != '\r';
}

std::string_view style_of(HtmlTable::Align align)
{
    return align == HtmlTable::Align::right ? " class=\"n\"" : "";
}

} // namespace

std::string escaped(std::string_view text)
{
    std::string out;
    for (const char letter : text) {
        if (const std::string_view found = entity(letter); !found.empty()) {
            out += found;
        } else if (forbidden(letter)) {
            out += "\xEF\xBF\xBD";
        } else {
            out += letter;
        }
    }
    return out;
}

std::string html_table(const HtmlTable& table)
{
    std::string text = "<table>\n<thead><tr>";
    for (const HtmlTable::Head& head : table.heads) {
        text += fmt::format("<th{}>{}</th>", style_of(head.align), escaped(head.text));
    }
    text += "</tr></thead>\n<tbody>\n";
    for (const auto& row : table.rows) {
        text += "<tr>";
        for (std::size_t k = 0; k < row.size(); ++k) {
            text += fmt::format("<td{}>{}</td>", style_of(table.heads[k].align), escaped(row[k]));
        }
        text += "</tr>\n";
    }
    return text + "</tbody>\n</table>\n";
}

std::string html_paragraph(std::string_view text)
{
    return fmt::format("<p>{}</p>\n", escaped(text));
}

} // namespace hyoryu
