// SPDX-License-Identifier: MIT
// Tables of numbers in text files that a case names.
#pragma once

#include "hyoryu/core/types.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace hyoryu {

/// Rows of numbers, and the mistakes of the file ("FILE:LINE: what is wrong"), if any.
struct NumberTable {
    std::vector<std::vector<double>> rows;
    std::vector<int> lines; // where each row stands
    std::vector<std::string> faults;
};

/// Reads rows of `columns` numbers separated by commas, semicolons or blanks. Empty lines, lines
/// that begin with # and one header line of words are passed over.
NumberTable read_number_table(const std::filesystem::path& file, std::size_t columns);

} // namespace hyoryu
