// SPDX-License-Identifier: MIT
// Pictures as PNG files, without an image library.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace hyoryu {

using Colour = std::array<std::uint8_t, 3>; // red, green, blue

/// A picture; its first row is the upper one.
struct Pixels {
    int width = 0, height = 0;
    std::vector<Colour> colour; // rows from left to right
};

/// Writes a PNG file (ISO/IEC 15948) of true colour. Throws IoError if it cannot.
void write_png(const std::filesystem::path& file, const Pixels& pixels);

} // namespace hyoryu
