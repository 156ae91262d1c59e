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

std::string html_paragraph(std::string_view text)
{
    return fmt::format("<p>{}</p>\n", escaped(text));
}

} // namespace hyoryu
