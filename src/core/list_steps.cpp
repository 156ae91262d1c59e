// SPDX-License-Identifier: MIT
#include "list_steps.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace hyoryu {

namespace {

constexpr int widest_step = 255;
// Registers of 16 bytes, which every machine has.
using Words = std::uint16_t __attribute__((vector_size(16)));
using Bytes = std::uint8_t __attribute__((vector_size(16)));
static_assert(steps_together == sizeof(Bytes));

// Eight differences between consecutive numbers; low bytes at even places, high bytes at odd
// places.
Bytes eight_steps(const std::uint16_t* number)
{
    Words to, from;
    std::memcpy(&to, number, sizeof to);
    std::memcpy(&from, number - 1, sizeof from);
    return reinterpret_cast<Bytes>(to - from);
}

// The farthest first slot of a padding chunk that one step reaches.
int padding_after(int number)
{
    constexpr int period = padding_period * chunk_slots;
    constexpr int first = period - chunk_slots;
    return (number + widest_step - first) / period * period + first;
}

// Writes up to `steps_together` steps; returns how many of them precede the first step that is too
// wide for one byte.
std::size_t write_together(const std::uint16_t* number, std::uint8_t* step)
{
    const Bytes a = eight_steps(number);
    const Bytes b = eight_steps(number + 8);
    const Bytes low =
        __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    const Bytes high =
        __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
    std::memcpy(step, &low, sizeof low);
    std::uint64_t parts[2];
    std::memcpy(parts, &high, sizeof high); // zero for every step that fits into one byte
    const int first = parts[0] != 0 ? std::countr_zero(parts[0]) : 64 + std::countr_zero(parts[1]);
    return static_cast<std::size_t>(first / 8);
}

// Writes the steps from one number to another by way of padding chunks; returns their end.
std::uint8_t* write_way(int from, int number, std::uint8_t* step)
{
    while (number - from > widest_step) {
        const int nothing = padding_after(from);
        *step++ = static_cast<std::uint8_t>(nothing - from);
        from = nothing;
    }
    *step++ = static_cast<std::uint8_t>(number - from);
    return step;
}

// Pads a list to whole packs with a slot of a padding chunk; returns the number of steps.
std::size_t fill_up(int number, std::size_t chunks, int lanes, std::uint8_t* first,
                    std::uint8_t* end)
{
    const auto made = static_cast<int>(end - first);
    const int full = (made + lanes - 1) / lanes * lanes;
    if (full > made) {
        const int last = static_cast<int>(chunks - 1) * chunk_slots;
        *end = static_cast<std::uint8_t>(std::min(padding_after(number), last) - number);
        std::fill(end + 1, first + full, std::uint8_t(0));
    }
    return static_cast<std::size_t>(full);
}

} // namespace

std::size_t write_steps(std::uint16_t* number, std::size_t count, std::size_t chunks, int lanes,
                        std::uint8_t* step)
{
    if (count == 0) {
        return 0;
    }
    std::fill_n(number + count, steps_together, number[count - 1]);
    std::uint8_t* out = step;
    *out++ = 0;
    std::size_t k = 1;
    while (k < count) {
        const std::size_t fit = write_together(number + k, out);
        k += fit;
        out += fit;
        if (fit < steps_together) {
            out = write_way(number[k - 1], number[k], out);
            ++k;
        }
    }
    out -= k - count;
    return fill_up(number[count - 1], chunks, lanes, step, out);
}

} // namespace hyoryu
