// SPDX-License-Identifier: MIT
// Letters of five by seven points, for pictures that are drawn without a library.
#pragma once

#include "hyoryu/io/png.hpp"

#include <array>
#include <string_view>

namespace hyoryu {

inline constexpr int letter_width = 12; // with the gap to the next one [pixels]
inline constexpr int letter_height = 14;

/// Fills the pixels from one to before another, given as column and row, as far as there are any.
void fill_box(Pixels& pixels, std::array<int, 2> from, std::array<int, 2> to, const Colour& colour);

/// Writes capitals, digits, `.`, `-` and blanks with their upper left corner at (left, top); other
/// characters are blanks. What is outside of the picture is left out.
void write_letters(Pixels& pixels, int left, int top, std::string_view text, const Colour& colour);

} // namespace hyoryu
