// SPDX-License-Identifier: MIT
// Values by type, unit and bounds.
#include "reader_table.hpp"

#include "hyoryu/scene/reader_hint.hpp"
#include "parameter_table.hpp"
#include "units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace hyoryu {

namespace {

std::optional<double> literal(std::string_view text)
{
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, fault] = std::from_chars(text.data(), end, value);
    return fault == std::errc{} && stop == end ? std::optional(value) : std::nullopt;
}

/// The numbers of a default such as "[0.0, 0.0, -9.81]".
std::optional<Vec3> literal_vector(std::string_view text)
{
    if (!text.starts_with('[') || !text.ends_with(']')) {
        return std::nullopt;
    }
    Vec3 value(0, 0, 0);
    text = text.substr(1, text.size() - 2);
    for (Index k = 0; k < 3; ++k) {
        const auto comma = text.find(',');
        const auto number = literal(text.substr(0, comma));
        if (!number || (comma == std::string_view::npos) != (k == 2)) {
            return std::nullopt;
        }
        value[k] = *number;
        text.remove_prefix(k == 2 ? text.size() : std::min(comma + 2, text.size()));
    }
    return value;
}

std::string in_unit(const Parameter& rule)
{
    return rule.unit.empty() ? "a number" : fmt::format("a number in {}", rule.unit);
}

std::string spaced_unit(const Parameter& rule)
{
    return rule.unit.empty() ? "" : fmt::format(" {}", rule.unit);
}

bool within(double value, const Parameter& rule)
{
    return rule.minimum_excluded ? value > rule.minimum && value <= rule.maximum
                                 : value >= rule.minimum && value <= rule.maximum;
}

} // namespace

void Reading::error(const Place& place, int override_number, std::string key, std::string what,
                    std::string hint)
{
    Diagnostic diagnostic{.key = std::move(key), .what = std::move(what), .hint = std::move(hint)};
    if (override_number >= 0) {
        diagnostic.file = "--set " + overrides[static_cast<std::size_t>(override_number)];
    } else {
        diagnostic.file = file.string();
        diagnostic.line = place.line;
        diagnostic.column = place.column;
        diagnostic.length = place.length;
        if (place.line > 0 && static_cast<std::size_t>(place.line) <= lines.size()) {
            diagnostic.source = lines[static_cast<std::size_t>(place.line) - 1];
        }
    }
    diagnostics.push_back(std::move(diagnostic));
}

void Reading::error(const TomlNode& node, std::string key, std::string what, std::string hint)
{
    error(node.place, node.override_number, std::move(key), std::move(what), std::move(hint));
}

std::optional<double> TableReader::to_number(const TomlNode& node, const Parameter& rule,
                                             const std::string& key)
{
    double value = 0;
    if (const auto* integer = std::get_if<std::int64_t>(&node.value)) {
        value = static_cast<double>(*integer);
    } else if (const auto* number = std::get_if<double>(&node.value)) {
        value = *number;
    } else if (const auto* text = std::get_if<std::string>(&node.value);
               text && !rule.unit.empty()) {
        ParsedQuantity quantity = parse_quantity(*text, rule.unit);
        if (!quantity.fault.empty() && rule.unit == "kg" && reading_.dimensions == 2) {
            quantity = parse_quantity(*text, "kg/m");
        }
        if (!quantity.fault.empty()) {
            reading_.error(node, key, quantity.fault, quantity.hint);
            return std::nullopt;
        }
        value = quantity.value;
    } else {
        reading_.error(node, key, fmt::format("expected {}, found {}", in_unit(rule), found(node)));
        return std::nullopt;
    }
    if (!std::isfinite(value)) {
        reading_.error(node, key, fmt::format("{} is no finite number", value));
        return std::nullopt;
    }
    if (const double largest = largest_value(rule.unit); std::abs(value) > largest) {
        reading_.error(node, key,
                       fmt::format("{}{} is out of range, expected at most {}{}", value,
                                   spaced_unit(rule), largest, spaced_unit(rule)));
        return std::nullopt;
    }
    if (!within(value, rule)) {
        reading_.error(node, key,
                       fmt::format("{}{} is out of range, expected {}{}", value, spaced_unit(rule),
                                   rule.bounds, spaced_unit(rule)));
        return std::nullopt;
    }
    return value;
}

std::optional<std::int64_t> TableReader::to_integer(const TomlNode& node, const Parameter& rule,
                                                    const std::string& key)
{
    const auto* integer = std::get_if<std::int64_t>(&node.value);
    if (integer == nullptr) {
        reading_.error(node, key, fmt::format("expected a whole number, found {}", found(node)));
        return std::nullopt;
    }
    if (!within(static_cast<double>(*integer), rule)) {
        reading_.error(node, key,
                       fmt::format("{} is out of range, expected {}", *integer, rule.bounds));
        return std::nullopt;
    }
    return *integer;
}

std::optional<double> TableReader::find_number(std::string_view key)
{
    const Parameter& rule = parameter(key);
    const TomlNode* node = ask(key);
    return node != nullptr ? to_number(*node, rule, full(key)) : literal(rule.fallback);
}

std::int64_t TableReader::integer(std::string_view key)
{
    const Parameter& rule = parameter(key);
    const TomlNode* node = ask(key);
    const auto fallback = static_cast<std::int64_t>(literal(rule.fallback).value_or(0));
    return node != nullptr ? to_integer(*node, rule, full(key)).value_or(fallback) : fallback;
}

bool TableReader::flag(std::string_view key)
{
    const TomlNode* node = ask(key);
    if (node == nullptr) {
        return parameter(key).fallback == "true";
    }
    const auto* value = std::get_if<bool>(&node->value);
    if (value == nullptr) {
        reading_.error(*node, full(key),
                       fmt::format("expected true or false, found {}", found(*node)));
    }
    return value != nullptr && *value;
}

std::string TableReader::text(std::string_view key)
{
    const TomlNode* node = ask(key);
    if (node == nullptr) {
        return {};
    }
    const auto* value = std::get_if<std::string>(&node->value);
    if (value == nullptr) {
        reading_.error(*node, full(key), fmt::format("expected a text, found {}", found(*node)));
    }
    return value != nullptr ? *value : std::string();
}

bool TableReader::is_choice(const TomlNode& node, const std::string& value, const Parameter& rule,
                            const std::string& key)
{
    if (rule.choices.empty() ||
        std::find(rule.choices.begin(), rule.choices.end(), value) != rule.choices.end()) {
        return true;
    }
    const auto planned = planned_keys();
    const bool is_planned = std::any_of(planned.begin(), planned.end(), [&](const PlannedKey& p) {
        return p.key == rule.key && p.value == value;
    });
    if (is_planned) {
        reading_.error(node, key,
                       fmt::format("this version does not have \"{}\" yet, it has {}", value,
                                   quoted_list(rule.choices)));
    } else {
        reading_.error(
            node, key,
            fmt::format("unknown \"{}\", expected one of {}", value, quoted_list(rule.choices)),
            did_you_mean(value, rule.choices));
    }
    return false;
}

std::string TableReader::choice(std::string_view key)
{
    const Parameter& rule = parameter(key);
    const TomlNode* node = ask(key);
    std::string value(rule.fallback == required ? "" : rule.fallback);
    if (node != nullptr) {
        const auto* text = std::get_if<std::string>(&node->value);
        if (text == nullptr) {
            reading_.error(*node, full(key),
                           fmt::format("expected one of {}, found {}", quoted_list(rule.choices),
                                       found(*node)));
        }
        value = text != nullptr && is_choice(*node, *text, rule, full(key)) ? *text : "";
    }
    if (chosen_.empty()) {
        chosen_ = fmt::format("{} = \"{}\"", key, value);
    }
    abandoned_ = abandoned_ || value.empty();
    return value;
}

std::vector<double> TableReader::numbers(std::string_view key)
{
    const Parameter& rule = parameter(key);
    std::vector<double> values;
    if (const TomlArray* items = ask_list(key, "numbers")) {
        for (std::size_t k = 0; k < items->size(); ++k) {
            const auto value = to_number((*items)[k], rule, fmt::format("{}[{}]", full(key), k));
            if (!value) {
                return {};
            }
            values.push_back(*value);
        }
    }
    return values;
}

std::vector<Vec3> TableReader::vectors(std::string_view key)
{
    const Parameter& rule = parameter(key);
    std::vector<Vec3> values;
    const TomlArray* items = ask_list(key, "lists of 3 numbers");
    for (std::size_t k = 0; items != nullptr && k < items->size(); ++k) {
        const TomlNode& item = (*items)[k];
        const std::string name = fmt::format("{}[{}]", full(key), k);
        const TomlArray* three = item.array();
        if (three == nullptr || three->size() != 3) {
            reading_.error(item, name,
                           fmt::format("expected a list of 3 numbers, found {}", found(item)));
            return {};
        }
        Vec3 value;
        for (int axis = 0; axis < 3; ++axis) {
            const auto number = to_number((*three)[static_cast<std::size_t>(axis)], rule, name);
            if (!number) {
                return {};
            }
            value[axis] = *number;
        }
        values.push_back(value);
    }
    return values;
}

std::vector<std::int64_t> TableReader::integers(std::string_view key)
{
    const Parameter& rule = parameter(key);
    std::vector<std::int64_t> values;
    if (const TomlArray* items = ask_list(key, "whole numbers")) {
        for (std::size_t k = 0; k < items->size(); ++k) {
            const auto value = to_integer((*items)[k], rule, fmt::format("{}[{}]", full(key), k));
            if (!value) {
                return {};
            }
            values.push_back(*value);
        }
    }
    return values;
}

std::vector<std::string> TableReader::texts(std::string_view key)
{
    const Parameter& rule = parameter(key);
    std::vector<std::string> values;
    if (const TomlArray* items = ask_list(key, "texts")) {
        for (std::size_t k = 0; k < items->size(); ++k) {
            const TomlNode& item = (*items)[k];
            const std::string name = fmt::format("{}[{}]", full(key), k);
            const auto* text = std::get_if<std::string>(&item.value);
            if (text == nullptr) {
                reading_.error(item, name, fmt::format("expected a text, found {}", found(item)));
            } else if (is_choice(item, *text, rule, name)) {
                values.push_back(*text);
            }
        }
    }
    return values;
}

std::optional<Vec3> TableReader::find_vector(std::string_view key)
{
    if (!has(key)) {
        ask(key);
        return literal_vector(parameter(key).fallback);
    }
    const std::vector<double> values = numbers(key);
    if (values.size() < 2) {
        return std::nullopt;
    }
    return Vec3(values[0], values[1], values.size() > 2 ? values[2] : 0.0);
}

std::optional<Vec3> TableReader::find_planar(std::string_view key)
{
    auto value = find_vector(key);
    if (value && reading_.dimensions == 2) {
        value->y() = 0;
    }
    return value;
}

std::optional<Vec3> TableReader::find_direction(std::string_view key)
{
    const auto direction = find_planar(key);
    if (!direction) {
        return std::nullopt;
    }
    const double norm = direction->norm();
    if (!(norm > 0) || !std::isfinite(norm)) {
        error(key, "has no direction");
        return std::nullopt;
    }
    // One that this program wrote is a unit up to rounding and is taken bit by bit.
    constexpr double rounding = 1e-14;
    return std::abs(sq(norm) - 1) < rounding ? *direction : Vec3(direction->normalized());
}

} // namespace hyoryu
