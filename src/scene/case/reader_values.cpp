// SPDX-License-Identifier: MIT
// Values by type, unit and bounds.
#include "reader_table.hpp"

#include "hyoryu/scene/reader_hint.hpp"
#include "units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

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

/// A shape that the format names for a table and this version does not have yet.
struct PlannedShape {
    std::string_view table;
    std::string_view name;
};
constexpr std::array planned{PlannedShape{"fluid.block[", "particles"}};

// In two dimensions areas are lengths, and discharges those per metre of width.
std::string_view unit_of(const Asked& asked)
{
    const std::string_view unit = asked.rule.unit;
    if (asked.reading.dimensions == 2 && (unit == "m2" || unit == "m3/s")) {
        return unit == "m2" ? "m" : "m2/s";
    }
    return unit;
}

/// The number of a text with a unit.
std::optional<double> quantity_of(const Asked& asked, const std::string& text)
{
    const std::string_view unit = unit_of(asked);
    ParsedQuantity quantity = parse_quantity(text, unit);
    if (!quantity.fault.empty() && unit == "kg" && asked.reading.dimensions == 2) {
        ParsedQuantity per_width = parse_quantity(text, "kg/m");
        quantity = per_width.fault.empty() ? std::move(per_width) : std::move(quantity);
    }
    if (!quantity.fault.empty()) {
        asked.refuse(quantity.fault, quantity.hint);
        return std::nullopt;
    }
    return quantity.value;
}

/// Whether a text is one of the choices of its rule, if it has some; notes it if not.
bool is_choice(const Asked& asked, const std::string& value)
{
    const std::vector<std::string_view>& choices = asked.rule.choices;
    if (choices.empty() || std::ranges::find(choices, value) != choices.end()) {
        return true;
    }
    const bool is_planned = std::ranges::any_of(planned, [&](const PlannedShape& shape) {
        return asked.rule.key == "shape" && shape.name == value &&
               asked.key.starts_with(shape.table);
    });
    return is_planned ? asked.refuse(fmt::format("\"{}\" is not supported yet, known: {}", value,
                                                 quoted_list(choices)))
                      : asked.refuse(fmt::format("unknown \"{}\", expected one of {}", value,
                                                 quoted_list(choices)),
                                     did_you_mean(value, choices));
}

std::string lengths(const Parameter& rule, std::string_view what)
{
    constexpr int practically_any = 100; // the bound is not worth a word
    if (rule.shortest == rule.longest) {
        return fmt::format("{} {}", rule.longest, what);
    }
    if (rule.longest < practically_any) {
        return fmt::format("{} to {} {}", rule.shortest, rule.longest, what);
    }
    return rule.shortest == 0 ? fmt::format("{}", what)
                              : fmt::format("at least {} {}", rule.shortest, what);
}

// The meaning of a key, as the hint of an error that has none of its own: of "wall[2].min[0]" the
// meaning of "wall[].min".
std::string meaning_of(const std::string& path)
{
    std::string key;
    bool within = false; // brackets, whose number is left out
    for (const char c : path) {
        within = within && c != ']';
        if (!within) {
            key += c;
        }
        within = within || c == '[';
    }
    const Parameter* rule = find_parameter(key);
    while (rule == nullptr && key.ends_with("[]")) {
        key.resize(key.size() - 2);
        rule = find_parameter(key);
    }
    const std::size_t name = key.find_last_of('.') + 1; // 0 if there is no dot
    const bool told = rule != nullptr && rule->kind != ValueKind::table &&
                      rule->kind != ValueKind::tables; // what a table is mends nothing
    return told ? fmt::format("`{}` is: {}", key.substr(name), rule->meaning) : std::string();
}

} // namespace

void Reading::error(const Place& place, int override_number, std::string key, std::string what,
                    std::string hint)
{
    if (hint.empty()) {
        hint = meaning_of(key);
    }
    Diagnostic diagnostic{.key = std::move(key), .what = std::move(what), .hint = std::move(hint)};
    if (override_number >= 0) {
        diagnostic.file = "--set " + overrides[at(override_number)];
    } else {
        diagnostic.file = file.string();
        diagnostic.line = place.line;
        diagnostic.column = place.column;
        diagnostic.length = place.length;
        if (place.line > 0 && at(place.line) <= lines.size()) {
            diagnostic.source = lines[at(place.line) - 1];
        }
    }
    diagnostics.push_back(std::move(diagnostic));
}

void Reading::warn(const Place& place, std::string key, std::string what, std::string hint)
{
    error(place, -1, std::move(key), std::move(what), std::move(hint));
    diagnostics.back().severity = Diagnostic::Severity::warning;
    notices.push_back(std::move(diagnostics.back()));
    diagnostics.pop_back();
}

void Reading::error(const TomlNode& node, std::string key, std::string what, std::string hint)
{
    error(node.place, node.override_number, std::move(key), std::move(what), std::move(hint));
}

bool Asked::refuse_kind(std::string_view expected) const
{
    return refuse(fmt::format("expected {}, found {}", expected, found(node)));
}

bool read(const Asked& asked, double& member)
{
    const Parameter& rule = asked.rule;
    double value = 0;
    if (const auto* integer = std::get_if<std::int64_t>(&asked.node.value)) {
        value = static_cast<double>(*integer);
    } else if (const auto* number = std::get_if<double>(&asked.node.value)) {
        value = *number;
    } else if (const auto* text = std::get_if<std::string>(&asked.node.value);
               text && !rule.unit.empty()) {
        const auto quantity = quantity_of(asked, *text);
        if (!quantity) {
            return false;
        }
        value = *quantity;
    } else {
        return asked.refuse_kind(in_unit(rule));
    }
    if (!std::isfinite(value)) {
        return asked.refuse(fmt::format("{} is not a finite number", value));
    }
    if (const double largest = largest_value(rule.unit); std::abs(value) > largest) {
        return asked.refuse(fmt::format("{}{} is out of range, expected at most {}{}", value,
                                        spaced_unit(rule), largest, spaced_unit(rule)));
    }
    if (!within(value, rule)) {
        return asked.refuse(fmt::format("{}{} is out of range, expected {}{}", value,
                                        spaced_unit(rule), rule.bounds, spaced_unit(rule)));
    }
    member = value;
    return true;
}

bool read(const Asked& asked, std::int64_t& member)
{
    const auto* integer = std::get_if<std::int64_t>(&asked.node.value);
    if (integer == nullptr) {
        return asked.refuse_kind("a whole number");
    }
    if (!within(static_cast<double>(*integer), asked.rule)) {
        return asked.refuse(
            fmt::format("{} is out of range, expected {}", *integer, asked.rule.bounds));
    }
    member = *integer;
    return true;
}

bool read(const Asked& asked, bool& member)
{
    const auto* value = std::get_if<bool>(&asked.node.value);
    if (value == nullptr) {
        return asked.refuse_kind("true or false");
    }
    member = *value;
    return true;
}

bool read(const Asked& asked, std::string& member)
{
    const auto* value = std::get_if<std::string>(&asked.node.value);
    if (value == nullptr) {
        return asked.refuse_kind("a text");
    }
    const bool sound = is_choice(asked, *value);
    member = sound ? *value : member;
    return sound;
}

bool read(const Asked& asked, NumberOrName& member)
{
    const auto* text = std::get_if<std::string>(&asked.node.value);
    const bool is_quantity =
        text == nullptr ||
        (!text->empty() &&
         std::string_view("+-.0123456789").find(text->front()) != std::string_view::npos);
    if (is_quantity) {
        return read(asked, member.number);
    }
    member.name = *text;
    return !text->empty() || asked.refuse("is empty, expected a number or a name");
}

const TomlArray* elements(const Asked& asked, std::string_view what)
{
    const TomlArray* items = asked.node.array();
    if (items == nullptr) {
        asked.refuse_kind("a list of " + lengths(asked.rule, what));
        return nullptr;
    }
    const auto count = static_cast<int>(items->size());
    if (count < asked.rule.shortest || count > asked.rule.longest) {
        asked.refuse(fmt::format("expected {}, found {}", lengths(asked.rule, what), count));
        return nullptr;
    }
    return items;
}

bool read(const Asked& asked, Vec3& member)
{
    if (asked.rule.kind == ValueKind::vectors) { // one of them
        const TomlArray* three = asked.node.array();
        if (three == nullptr || three->size() != 3) {
            return asked.refuse_kind("a list of 3 numbers");
        }
        const auto read_axis = [&](std::size_t axis) {
            return read({asked.reading, (*three)[axis], asked.rule, asked.key},
                        member[static_cast<Index>(axis)]);
        };
        return read_axis(0) && read_axis(1) && read_axis(2);
    }
    std::vector<double> values;
    if (!read(asked, values)) {
        return false;
    }
    member = Vec3(values[0], values[1], values.size() > 2 ? values[2] : 0.0);
    return true;
}

bool read(const Asked& asked, Quat& member)
{
    std::vector<double> q;
    if (!read(asked, q)) {
        return false;
    }
    const Quat rotation(q[0], q[1], q[2], q[3]);
    // A quaternion that this program wrote is a unit up to rounding and is taken bit by bit.
    constexpr double rounding = 1e-14;
    constexpr double typed = 1e-3;
    const double excess = std::abs(rotation.squaredNorm() - 1);
    if (!(excess < typed)) {
        return asked.refuse(
            fmt::format("is not a unit quaternion, its norm is {:.6g}", rotation.norm()));
    }
    if (asked.reading.dimensions == 2 && (q[1] != 0 || q[3] != 0)) {
        return asked.refuse("in two dimensions rotations are about y");
    }
    member = excess < rounding ? rotation : rotation.normalized();
    return true;
}

} // namespace hyoryu
