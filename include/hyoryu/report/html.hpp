// SPDX-License-Identifier: MIT
// Pieces of a page that is both HTML and well-formed XML.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hyoryu {

/// The text as it may stand in an element or an attribute: & < > " ' become entities, and control
/// characters, which XML forbids, the replacement character U+FFFD.
std::string escaped(std::string_view text);

struct HtmlTable {
    enum class Align { left, right };
    struct Head {
        std::string text;
        Align align = Align::left;
    };
    std::vector<Head> heads;
    std::vector<std::vector<std::string>> rows; // one cell a head; plain text
};
std::string html_table(const HtmlTable& table);

/// A paragraph of plain text.
std::string html_paragraph(std::string_view text);

} // namespace hyoryu
