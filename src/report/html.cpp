// SPDX-License-Identifier: MIT
#include "hyoryu/report/html.hpp"

#include "hyoryu/core/name.hpp"

#include <fmt/format.h>

namespace hyoryu {

namespace {

bool forbidden(char letter)
{
    const auto code = static_cast<unsigned char>(letter);
    return code < 0x20 && letter != '\n' && letter != '\t' && letter != '\r';
}

} // namespace

std::string escaped(std::string_view text)
{
    std::string out;
    for (const char letter : replaced(
             text,
             {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}})) {
        out += forbidden(letter) ? std::string("\xEF\xBF\xBD") : std::string(1, letter);
    }
    return out;
}

std::string html_paragraph(std::string_view text)
{
    return fmt::format("<p>{}</p>\n", escaped(text));
}

} // namespace hyoryu
