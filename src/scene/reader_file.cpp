// SPDX-License-Identifier: MIT
// Names within a case, of files and of everything else.
#include "reader.hpp"

#include "hyoryu/core/input_file.hpp"
#include "hyoryu/core/name.hpp"

#include <fmt/format.h>

namespace hyoryu {

std::optional<std::filesystem::path> read_file_path(TableReader& table, std::string_view key)
{
    table.require(key);
    const std::size_t mistakes = table.reading().diagnostics.size();
    const std::string name = table.text(key);
    if (!table.has(key) || table.reading().diagnostics.size() != mistakes) {
        return std::nullopt;
    }
    const bool bad = has_control_characters(name);
    if (name.empty() || bad) {
        table.error(key,
                    name.empty() ? "is empty, expected the name of a file"
                                 : "holds control characters, expected the name of a file",
                    "a path relative to the case file");
        return std::nullopt;
    }
    const auto folder = table.reading().file.parent_path();
    auto path = std::filesystem::absolute(folder / name).lexically_normal();
    const std::string why = why_unreadable(path);
    if (!why.empty()) {
        table.error(key, fmt::format("the file {} {}", path.string(), why),
                    "the path is relative to the case file");
        return std::nullopt;
    }
    return path;
}

void check_name(TableReader& table, std::string_view key, const std::string& name)
{
    const std::string fault = name_fault(name);
    if (!fault.empty()) {
        table.error(key, "is no name: " + fault,
                    "use letters, digits, blanks within, `_`, `-` and `.`");
    }
}

} // namespace hyoryu
