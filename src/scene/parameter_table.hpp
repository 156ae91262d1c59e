// SPDX-License-Identifier: MIT
// The parts of the table of keys, and short ways to write a row of it.
#pragma once

#include "hyoryu/scene/parameter.hpp"

namespace hyoryu {

// The parts, in the order of the manual.
std::vector<Parameter> general_parameters();
std::vector<Parameter> fluid_parameters();
std::vector<Parameter> wall_parameters();
std::vector<Parameter> body_parameters();
std::vector<Parameter> contact_parameters();
std::vector<Parameter> output_parameters();

/// A key, or a value of a key, that the format names and this version does not have yet.
struct PlannedKey {
    std::string_view key;
    std::string_view value; // of a choice; "" for the key itself
};
std::span<const PlannedKey> planned_keys();

/// The default of a key that must be given.
inline constexpr std::string_view required = "required";

// Rows. What a row leaves out (unit, default) is given last, so that a table reads as text.

inline Parameter table_row(std::string_view key, std::string_view meaning)
{
    return {.key = key, .kind = ValueKind::table, .meaning = meaning};
}
inline Parameter tables_row(std::string_view key, std::string_view meaning)
{
    return {.key = key, .kind = ValueKind::tables, .meaning = meaning};
}
inline Parameter any_number(std::string_view key, std::string_view unit, std::string_view fallback,
                            std::string_view meaning)
{
    return {.key = key,
            .kind = ValueKind::number,
            .unit = unit,
            .fallback = fallback,
            .meaning = meaning};
}
inline Parameter positive(std::string_view key, std::string_view unit, std::string_view fallback,
                          std::string_view meaning)
{
    Parameter row = any_number(key, unit, fallback, meaning);
    row.bounds = "> 0";
    row.minimum = 0;
    row.minimum_excluded = true;
    return row;
}
inline Parameter not_negative(std::string_view key, std::string_view unit,
                              std::string_view fallback, std::string_view meaning)
{
    Parameter row = any_number(key, unit, fallback, meaning);
    row.bounds = ">= 0";
    row.minimum = 0;
    return row;
}
inline Parameter fraction(std::string_view key, std::string_view fallback, std::string_view meaning)
{
    Parameter row = not_negative(key, "", fallback, meaning);
    row.bounds = "0 .. 1";
    row.maximum = 1;
    return row;
}
inline Parameter vector_row(std::string_view key, std::string_view unit, std::string_view fallback,
                            std::string_view meaning)
{
    Parameter row = any_number(key, unit, fallback, meaning);
    row.kind = ValueKind::vector;
    row.shortest = row.longest = 3;
    return row;
}
inline Parameter text_row(std::string_view key, std::string_view fallback, std::string_view meaning)
{
    return {.key = key, .kind = ValueKind::text, .fallback = fallback, .meaning = meaning};
}
inline Parameter choice_row(std::string_view key, std::vector<std::string_view> choices,
                            std::string_view fallback, std::string_view meaning)
{
    Parameter row = text_row(key, fallback, meaning);
    row.kind = ValueKind::choice;
    row.choices = std::move(choices);
    return row;
}
inline Parameter texts_row(std::string_view key, std::vector<std::string_view> choices,
                           std::string_view fallback, std::string_view meaning)
{
    Parameter row = choice_row(key, std::move(choices), fallback, meaning);
    row.kind = ValueKind::texts;
    row.longest = 100;
    return row;
}

} // namespace hyoryu
