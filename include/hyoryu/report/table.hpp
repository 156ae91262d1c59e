// SPDX-License-Identifier: MIT
// A table of plain text on a page, in a document or on a terminal.
#pragma once

#include <string>
#include <vector>

namespace hyoryu {

struct TextTable {
    enum class Align { left, right };
    struct Head {
        std::string text;
        Align align = Align::left;
    };
    std::vector<Head> heads;
    std::vector<std::vector<std::string>> rows; // one cell a head
};

std::string html_table(const TextTable& table);
/// With bars escaped, which would end a cell, and line breaks as spaces.
std::string markdown_table(const TextTable& table);
/// Columns as wide as their widest cell.
std::string terminal_table(const TextTable& table);

} // namespace hyoryu
