// SPDX-License-Identifier: MIT
// The table of units and the reading of products, quotients and powers of them.
#include "units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace hyoryu {

namespace {

struct NamedUnit {
    std::string_view name;
    Unit unit;
};

// Powers of metre, kilogram, second and radian.
constexpr std::array<int, 4> of_length{1, 0, 0, 0}, of_mass{0, 1, 0, 0}, of_duration{0, 0, 1, 0},
    of_angle{0, 0, 0, 1}, of_force{1, 1, -2, 0}, of_stress{-1, 1, -2, 0};

constexpr std::array named_units = {
    NamedUnit{"m", {of_length, 1, 1}},
    NamedUnit{"cm", {of_length, 1, 100}},
    NamedUnit{"mm", {of_length, 1, 1000}},
    NamedUnit{"km", {of_length, 1000, 1}},
    NamedUnit{"ft", {of_length, 3048, 10000}},
    NamedUnit{"in", {of_length, 254, 10000}},
    NamedUnit{"s", {of_duration, 1, 1}},
    NamedUnit{"ms", {of_duration, 1, 1000}},
    NamedUnit{"min", {of_duration, 60, 1}},
    NamedUnit{"h", {of_duration, 3600, 1}},
    NamedUnit{"kg", {of_mass, 1, 1}},
    NamedUnit{"g", {of_mass, 1, 1000}},
    NamedUnit{"t", {of_mass, 1000, 1}},
    NamedUnit{"N", {of_force, 1, 1}},
    NamedUnit{"kN", {of_force, 1e3, 1}},
    NamedUnit{"MN", {of_force, 1e6, 1}},
    NamedUnit{"Pa", {of_stress, 1, 1}},
    NamedUnit{"kPa", {of_stress, 1e3, 1}},
    NamedUnit{"MPa", {of_stress, 1e6, 1}},
    NamedUnit{"GPa", {of_stress, 1e9, 1}},
    NamedUnit{"bar", {of_stress, 1e5, 1}},
    NamedUnit{"J", {{2, 1, -2, 0}, 1, 1}},
    NamedUnit{"W", {{2, 1, -3, 0}, 1, 1}},
    NamedUnit{"rad", {of_angle, 1, 1}},
    NamedUnit{"deg", {of_angle, std::numbers::pi, 180}},
};

std::optional<Unit> named_unit(std::string_view name)
{
    for (const NamedUnit& known : named_units) {
        if (known.name == name) {
            return known.unit;
        }
    }
    return name == "1" ? std::optional(Unit{}) : std::nullopt;
}

void multiply(Unit& product, const Unit& factor, int power)
{
    for (std::size_t k = 0; k < product.powers.size(); ++k) {
        product.powers[k] += power * factor.powers[k];
    }
    for (int n = 0; n < std::abs(power); ++n) {
        product.up *= power > 0 ? factor.up : factor.down;
        product.down *= power > 0 ? factor.down : factor.up;
    }
}

bool take(std::string_view& text, std::string_view front)
{
    if (!text.starts_with(front)) {
        return false;
    }
    text.remove_prefix(front.size());
    return true;
}

void skip_blanks(std::string_view& text)
{
    while (take(text, " ") || take(text, "\t")) {
    }
}

/// The name of a unit at the front of the text: letters, or the 1 of "1/s".
std::string_view take_name(std::string_view& text)
{
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    std::size_t length = 0;
    while (length < text.size() && is_letter(text[length])) {
        ++length;
    }
    if (length == 0 && text.starts_with("1")) {
        length = 1;
    }
    const std::string_view name = text.substr(0, length);
    text.remove_prefix(length);
    return name;
}

/// The exponent at the front of the text: "3", "^3", "^-1", "²"; 1 if there is none, 0 if it is
/// bad.
int take_power(std::string_view& text)
{
    if (take(text, "²")) {
        return 2;
    }
    if (take(text, "³")) {
        return 3;
    }
    const bool caret = take(text, "^");
    int power = 1;
    const auto [stop, fault] = std::from_chars(text.data(), text.data() + text.size(), power);
    if (fault != std::errc{}) {
        return caret ? 0 : 1;
    }
    text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
    constexpr int highest = 9;
    return -highest <= power && power <= highest ? power : 0;
}

std::string units_that_fit(std::string_view expected)
{
    const auto wanted = parse_unit(expected);
    std::string list;
    for (const NamedUnit& known : named_units) {
        if (wanted && known.unit.powers == wanted->powers) {
            list += (list.empty() ? "" : ", ") + std::string(known.name);
        }
    }
    return fmt::format("units of this dimension: {}", list.empty() ? std::string(expected) : list);
}

} // namespace

std::optional<Unit> parse_unit(std::string_view text)
{
    constexpr std::size_t longest = 64;
    Unit unit;
    skip_blanks(text);
    int sign = take(text, "/") ? -1 : 1;
    skip_blanks(text);
    if (text.empty() || text.size() > longest) {
        return std::nullopt;
    }
    while (true) {
        const auto factor = named_unit(take_name(text));
        const int power = factor ? take_power(text) : 0;
        if (power == 0) {
            return std::nullopt;
        }
        multiply(unit, *factor, sign * power);
        skip_blanks(text);
        if (text.empty()) {
            return unit;
        }
        sign = take(text, "/") ? -1 : 1;
        if (sign > 0 && !take(text, "*") && !take(text, "·")) {
            take(text, ".");
        }
        skip_blanks(text);
    }
}

ParsedQuantity parse_quantity(std::string_view text, std::string_view expected)
{
    std::string_view rest = text;
    skip_blanks(rest);
    const bool plus = take(rest, "+");
    double number = 0;
    const auto [stop, fault] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    if (fault != std::errc{} || !std::isfinite(number) || (plus && rest.starts_with("-"))) {
        return {0, fmt::format("expected a number in {}, found the text \"{}\"", expected, text),
                fmt::format("a number, or a text with a number and a unit such as \"10 {}\"",
                            expected)};
    }
    rest.remove_prefix(static_cast<std::size_t>(stop - rest.data()));
    skip_blanks(rest);
    while (rest.ends_with(' ') || rest.ends_with('\t')) {
        rest.remove_suffix(1);
    }
    if (rest.empty()) {
        return {0, fmt::format("the text \"{}\" has no unit", text),
                fmt::format("write {} without quotes, or \"{} {}\"", number, number, expected)};
    }
    if (rest == expected) {
        return {number, {}, {}};
    }
    const auto unit = parse_unit(rest);
    const auto wanted = parse_unit(expected);
    if (!unit || !wanted) {
        return {0, fmt::format("unknown unit \"{}\"", rest), units_that_fit(expected)};
    }
    if (unit->powers != wanted->powers) {
        return {0,
                fmt::format("the unit \"{}\" has another dimension, expected {}", rest, expected),
                units_that_fit(expected)};
    }
    return {number * (unit->up * wanted->down) / (unit->down * wanted->up), {}, {}};
}

double largest_value(std::string_view unit)
{
    constexpr std::array<std::pair<std::string_view, double>, 9> limits{{{"m", 1e8},
                                                                         {"m/s", 1e6},
                                                                         {"rad/s", 1e6},
                                                                         {"deg", 1e6},
                                                                         {"kg", 1e15},
                                                                         {"kg/m3", 1e6},
                                                                         {"N/m", 1e18},
                                                                         {"Pa", 1e12},
                                                                         {"m2/s", 1e6}}};
    const auto at = std::ranges::find(limits, unit, &std::pair<std::string_view, double>::first);
    return at == limits.end() ? std::numeric_limits<double>::infinity() : at->second;
}

} // namespace hyoryu
