// SPDX-License-Identifier: MIT
// Units that a user may type: "10 cm", "998 kg/m3", "1e-6 m2/s", checked for their dimension.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace hyoryu {

/// A unit as powers of metre, kilogram, second and radian and its size in them, kept as a fraction
/// so that "35 cm" is the double nearest to 0.35.
struct Unit {
    std::array<int, 4> powers{}; // of m, kg, s, rad
    double up = 1;
    double down = 1;
};

/// The unit of a text such as "kg/m3", "kg/m^3", "m s^-2", "deg"; none if it is not understood.
std::optional<Unit> parse_unit(std::string_view text);

/// Largest magnitude that a scene may have in the unit: farther, faster or heavier than anything on
/// Earth, and small enough for squares and sums. Infinity for units that are bounded elsewhere.
double largest_value(std::string_view unit);

/// A number typed as a text with a unit.
struct ParsedQuantity {
    double value = 0;  // in the expected unit
    std::string fault; // the mistake; empty if there is none
    std::string hint;
};

/// Reads "10 cm" as a value in the unit `expected`, for instance "m".
ParsedQuantity parse_quantity(std::string_view text, std::string_view expected);

} // namespace hyoryu
