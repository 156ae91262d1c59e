// SPDX-License-Identifier: MIT
// Compiled once for each instruction set.
#include "../list_loops.hpp"

#include <cstring>
#ifdef __AVX__
#include <immintrin.h>
#endif

namespace hyoryu {

namespace {

constexpr int bytes = HYORYU_REGISTER_BYTES;

// Eight points or boxes at a time, whatever the registers: a chunk.
using Floats = float __attribute__((vector_size(32)));
using Integers = std::int32_t __attribute__((vector_size(32)));
using Words = std::uint16_t __attribute__((vector_size(16)));

// For each pattern of hits: their places, and how many.
struct Patterns {
    std::uint16_t place[256][8];
    std::uint8_t count[256];
};
constexpr Patterns make_patterns()
{
    Patterns patterns{};
    for (int pattern = 0; pattern < 256; ++pattern) {
        std::uint8_t count = 0;
        for (std::uint16_t lane = 0; lane < 8; ++lane) {
            if ((pattern >> lane & 1) != 0) {
                patterns.place[pattern][count++] = lane;
            }
        }
        patterns.count[pattern] = count;
    }
    return patterns;
}
constexpr Patterns patterns = make_patterns();

Floats load(const float* from)
{
    Floats lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
}

// One bit a lane that is true.
std::size_t bits_of(const Integers& hit)
{
#ifdef __AVX__
    return static_cast<std::size_t>(_mm256_movemask_ps(reinterpret_cast<__m256>(hit)));
#else
    Integers bits = hit & Integers{1, 2, 4, 8, 16, 32, 64, 128};
    bits |= __builtin_shufflevector(bits, bits, 4, 5, 6, 7, 4, 5, 6, 7);
    bits |= __builtin_shufflevector(bits, bits, 2, 3, 2, 3, 2, 3, 2, 3);
    return static_cast<std::size_t>(bits[0] | bits[1]);
#endif
}

// Appends first + k for the lanes k that are true: eight places are written, the end moves on by
// the hits.
std::uint16_t* append(const Integers& hit, std::uint16_t first, std::uint16_t* out)
{
    const std::size_t pattern = bits_of(hit);
    Words places;
    std::memcpy(&places, patterns.place[pattern], sizeof places);
    places += first;
    std::memcpy(out, &places, sizeof places);
    return out + patterns.count[pattern];
}

Floats positive_part(const Floats& x)
{
    return x > 0 ? x : Floats{};
}

int filter(const Candidates& all, const std::array<float, 3>& point, float radius, int lanes,
           std::uint16_t* near, std::uint16_t* entry)
{
    const float limit = radius * radius;
    const float* const at = &point[0];
    std::uint16_t* end = near;
    for (std::int32_t chunk = 0; chunk < all.chunks; chunk += chunk_slots) {
        Floats squared{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Floats gap = positive_part(load((&all.low[0])[axis] + chunk) - at[axis]) +
                               positive_part(at[axis] - load((&all.high[0])[axis] + chunk));
            squared += gap * gap;
        }
        end = append(squared <= limit, static_cast<std::uint16_t>(chunk), end);
    }
    std::uint16_t* out = entry;
    for (; near != end; ++near) {
        const auto first = static_cast<std::uint16_t>(*near * chunk_slots);
        Floats squared{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Floats way = load((&all.points[0])[axis] + first) - at[axis];
            squared += way * way;
        }
        out = append(squared <= limit, first, out);
    }
    const auto nothing = static_cast<std::uint16_t>(all.chunks * chunk_slots);
    while ((out - entry) % lanes != 0) {
        *out++ = nothing;
    }
    return static_cast<int>(out - entry);
}

} // namespace

template <>
const ListLoops* list_loops<bytes>()
{
    static constexpr ListLoops loops{filter};
    return &loops;
}

} // namespace hyoryu
