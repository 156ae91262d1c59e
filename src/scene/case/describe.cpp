// SPDX-License-Identifier: MIT
// The table of keys as a manual on the terminal.
#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/parameter.hpp"

#include "hyoryu/scene/reader_hint.hpp"
#include "keys.hpp"

#include <fmt/format.h>

namespace hyoryu {

namespace {

std::string kind_of(const Parameter& parameter)
{
    const bool free_length = parameter.shortest != parameter.longest;
    const std::string count = free_length ? "" : fmt::format("{} ", parameter.longest);
    switch (parameter.kind) {
    case ValueKind::number:
        return "number";
    case ValueKind::number_or_name:
        return "number or text";
    case ValueKind::integer:
        return "whole number";
    case ValueKind::boolean:
        return "true or false";
    case ValueKind::text:
    case ValueKind::choice:
        return "text";
    case ValueKind::vector:
        return fmt::format("list of {}numbers",
                           !free_length ? count
                           : parameter.longest == parameter.shortest + 1
                               ? fmt::format("{} or {} ", parameter.shortest, parameter.longest)
                               : fmt::format("{} or more ", parameter.shortest));
    case ValueKind::vectors:
        return "list of lists of 3 numbers";
    case ValueKind::integers:
        return fmt::format("list of {}whole numbers", count);
    case ValueKind::texts:
        return fmt::format("list of {}texts", count);
    case ValueKind::table:
        return fmt::format("table, written [{}]", plain_key(parameter.key));
    case ValueKind::tables:
        return fmt::format("tables, each written [[{}]]", plain_key(parameter.key));
    }
    return {};
}

std::string entry_text(const Parameter& parameter)
{
    std::string text = fmt::format("{}\n    {}", parameter.key, kind_of(parameter));
    if (!parameter.unit.empty()) {
        text += fmt::format(" in {}", parameter.unit);
    }
    if (!parameter.bounds.empty()) {
        text += fmt::format(", {}", parameter.bounds);
    }
    if (parameter.fallback == required) {
        text += ", required";
    } else if (!parameter.fallback.empty()) {
        text += fmt::format(", default {}", parameter.fallback);
    }
    if (!parameter.choices.empty()) {
        text += fmt::format("\n    one of {}", quoted_list(parameter.choices));
    }
    return text + fmt::format("\n    {}\n", parameter.meaning);
}

[[noreturn]] void refuse(std::string_view key)
{
    std::vector<std::string> names;
    for (const Parameter& parameter : parameters()) {
        names.push_back(plain_key(parameter.key));
    }
    const std::vector<std::string_view> candidates(names.begin(), names.end());
    const std::string near = did_you_mean(plain_key(key), candidates);
    throw CaseError(fmt::format("unknown key \"{}\"", key),
                    near.empty() ? "`hyoryu describe` lists all keys" : near);
}

} // namespace

std::string plain_key(std::string_view key)
{
    std::string text;
    bool inside = false;
    for (const char c : key) {
        inside = c == '[' || (inside && c != ']');
        if (!inside && c != ']') {
            text += c;
        }
    }
    return text;
}

std::string describe(std::string_view key)
{
    const std::string wanted = plain_key(key);
    std::string text;
    for (const Parameter& parameter : parameters()) {
        const std::string name = plain_key(parameter.key);
        if (wanted.empty() || name == wanted || name.starts_with(wanted + ".")) {
            text += text.empty() ? "" : "\n";
            text += entry_text(parameter);
        }
    }
    if (text.empty()) {
        refuse(key);
    }
    return text;
}

} // namespace hyoryu
