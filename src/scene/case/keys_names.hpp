// SPDX-License-Identifier: MIT
// The rules of names: of walls and bodies, of materials, of files.
#pragma once

#include "reader_table.hpp"

#include "hyoryu/core/input_file.hpp"
#include "hyoryu/core/name.hpp"

#include <fmt/format.h>

namespace hyoryu {

/// The default that another key gives.
inline void inherit(TableReader& /*table*/, double& value, double from)
{
    value = from;
}

/// In two dimensions notes that what a key asks for needs three; whether it did.
inline bool refuse_flat(TableReader& table, std::string_view key, std::string_view what_are)
{
    const bool flat = table.reading().dimensions == 2;
    if (flat) {
        table.error(key, fmt::format("{} supported in three dimensions only", what_are),
                    "set `dimensions = 3`");
    }
    return flat;
}

inline std::optional<std::filesystem::path> path_of_file(TableReader& table, std::string_view key,
                                                         const std::string& name)
{
    if (!table.sound(key)) {
        return std::nullopt;
    }
    const bool bad = has_control_characters(name);
    if (name.empty() || bad) {
        table.error(key,
                    name.empty() ? "is empty, expected a file name"
                                 : "contains control characters, expected a file name",
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

inline void number_name(TableReader& table, std::string_view kind, std::string& name)
{
    name = fmt::format("{}.{}", kind, table.number_of_table());
}

inline void check_name(TableReader& table, std::string_view key, const std::string& name)
{
    if (table.mistaken({key})) {
        table.reading().names_known = false;
        return;
    }
    const std::string fault = name_fault(name);
    if (!fault.empty()) {
        table.error(key, "is not a valid name: " + fault,
                    "use letters, digits, `_`, `-`, `.`, and spaces within the name");
    }
}

inline void check_material(TableReader& table, const std::string& material)
{
    if (!material.empty() || table.mistaken({"material"})) {
        check_name(table, "material", material);
    }
}

inline void claim_name(TableReader& table, const std::string& name)
{
    const auto [at, is_new] = table.reading().names.emplace(name, table.place().line);
    if (!is_new) {
        const std::string first =
            at->second > 0 ? fmt::format(", first in line {}", at->second) : "";
        table.error("name", fmt::format("the name \"{}\" is used twice{}", name, first),
                    "names of walls and bodies must differ");
    }
}

} // namespace hyoryu
