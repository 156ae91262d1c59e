// SPDX-License-Identifier: MIT
// Tables of numbers in text files that a case names.
#pragma once

#include "hyoryu/core/types.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyoryu {

/// A column that a table must have.
struct NumberColumn {
    std::string_view name;
    std::string_view unit; // of its numbers, which a header may repeat: "time [s]"
};

/// Rows of numbers, and the mistakes of the file ("FILE:LINE: what is wrong"), if any.
struct NumberTable {
    std::vector<std::vector<double>> rows; // in the order of the columns asked for
    std::vector<int> lines;                // where each row stands
    std::vector<std::string> faults;
};

/// Reads rows of numbers separated by commas, semicolons or blanks. Empty lines and lines that
/// begin with # are passed over. A first line of words is the header: it names every column once,
/// in any order, with or without its unit; without it the columns are as asked for.
NumberTable read_number_table(const std::filesystem::path& file,
                              std::span<const NumberColumn> columns);

} // namespace hyoryu
