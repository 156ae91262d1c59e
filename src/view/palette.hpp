// SPDX-License-Identifier: MIT
// Colours of objects that are not coloured by a value.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hyoryu {

using Rgb = std::array<std::uint8_t, 3>;

// Pine, oak, larch, walnut, cedar, beech: bodies of consecutive numbers are distinguishable.
inline constexpr std::array<Rgb, 6> woods{{{206, 160, 104},
                                           {158, 108, 62},
                                           {222, 184, 130},
                                           {128, 84, 52},
                                           {182, 116, 78},
                                           {196, 148, 112}}};
// Concrete, plaster, stone.
inline constexpr std::array<Rgb, 3> stones{{{206, 204, 198}, {216, 208, 194}, {190, 188, 184}}};

template <std::size_t N>
constexpr const Rgb& pick(const std::array<Rgb, N>& palette, std::int32_t index)
{
    return palette[static_cast<std::size_t>(index < 0 ? 0 : index) % N];
}

} // namespace hyoryu
