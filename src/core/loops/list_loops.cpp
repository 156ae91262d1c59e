// SPDX-License-Identifier: MIT
// Compiled once for each instruction set.
#include "../list_loops.hpp"

#include <bit>
#include <cstring>
#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace hyoryu {

namespace {

constexpr int bytes = HYORYU_REGISTER_BYTES;

// Points or boxes per operation: those of one chunk, or of two if a register holds them.
constexpr int width = bytes == 64 ? 16 : chunk_slots;
using Floats = float __attribute__((vector_size(4 * width)));
using Integers = std::int32_t __attribute__((vector_size(4 * width)));
using EightFloats = float __attribute__((vector_size(32)));
using EightWords = std::uint16_t __attribute__((vector_size(16)));

template <class Register>
Register load(const auto* from)
{
    Register lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
}

#ifdef __AVX512VL__
static_assert(width == 16);

// The eight points of each of two chunks.
Floats load_chunks(const float* column, const std::int32_t* chunk)
{
    const auto a = load<EightFloats>(column + chunk_slots * chunk[0]);
    const auto b = load<EightFloats>(column + chunk_slots * chunk[1]);
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}

// Mask of the lanes that are at most the limit. Written with intrinsics: from the vector operators
// GCC 12 makes a full register first, and two instructions for a maximum.
auto within(const Floats& squared, float limit)
{
    return _mm512_cmp_ps_mask(reinterpret_cast<__m512>(squared), _mm512_set1_ps(limit), _CMP_LE_OQ);
}
Floats larger(const Floats& a, const Floats& b)
{
    return reinterpret_cast<Floats>(
        _mm512_max_ps(reinterpret_cast<__m512>(a), reinterpret_cast<__m512>(b)));
}

// Appends the numbers of the hit lanes: all lanes are written, the end advances by the number of
// hits.
template <class T>
T* append(__mmask16 hit, __m512i numbers, T* out)
{
    const __m512i hits = _mm512_maskz_compress_epi32(hit, numbers);
    if constexpr (sizeof(T) == 4) {
        _mm512_storeu_si512(out, hits);
    } else {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), _mm512_cvtepi32_epi16(hits));
    }
    return out + __builtin_popcount(hit);
}

std::int32_t* append_chunks(__mmask16 hit, std::int32_t first, std::int32_t* out)
{
    const Integers lane{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    return append(hit, reinterpret_cast<__m512i>(lane + first), out);
}
std::uint16_t* append_points(__mmask16 hit, const std::int32_t* chunk, std::uint16_t* out)
{
    const Integers lane{0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7};
    const __m512i of_lane = _mm512_mask_set1_epi32(_mm512_set1_epi32(chunk[0]), 0xff00, chunk[1]);
    return append(
        hit, reinterpret_cast<__m512i>(reinterpret_cast<Integers>(of_lane) * chunk_slots + lane),
        out);
}
#else
Floats load_chunks(const float* column, const std::int32_t* chunk)
{
    return load<Floats>(column + chunk_slots * *chunk);
}

// For each pattern of hits: the hit lanes and their count.
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

// `within`: one bit for each lane that is at most the limit; `larger`: lane-wise maximum.
#if defined __AVX__
std::size_t within(const Floats& squared, float limit)
{
    const Integers hit = squared <= limit;
    return static_cast<std::size_t>(_mm256_movemask_ps(reinterpret_cast<__m256>(hit)));
}
Floats larger(const Floats& a, const Floats& b)
{
    return a > b ? a : b;
}
#elif defined __SSE2__
// In two halves: GCC 12 compiles comparisons wider than a register lane by lane.
struct Halves {
    __m128 low, high;
};
std::size_t within(const Floats& squared, float limit)
{
    const auto halves = std::bit_cast<Halves>(squared);
    const auto hits = [&](const __m128& half) {
        return static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(half, _mm_set1_ps(limit))));
    };
    return hits(halves.low) | hits(halves.high) << 4;
}
Floats larger(const Floats& a, const Floats& b)
{
    const auto x = std::bit_cast<Halves>(a);
    const auto y = std::bit_cast<Halves>(b);
    return std::bit_cast<Floats>(Halves{_mm_max_ps(x.low, y.low), _mm_max_ps(x.high, y.high)});
}
#else
std::size_t within(const Floats& squared, float limit)
{
    Integers bits = (squared <= limit) & Integers{1, 2, 4, 8, 16, 32, 64, 128};
    bits |= __builtin_shufflevector(bits, bits, 4, 5, 6, 7, 4, 5, 6, 7);
    bits |= __builtin_shufflevector(bits, bits, 2, 3, 2, 3, 2, 3, 2, 3);
    return static_cast<std::size_t>(bits[0] | bits[1]);
}
Floats larger(const Floats& a, const Floats& b)
{
    return a > b ? a : b;
}
#endif

// Appends first + k for the hit lanes k: eight values are written, the end advances by the number
// of hits.
std::int32_t* append_chunks(std::size_t hit, std::int32_t first, std::int32_t* out)
{
    const auto lanes = load<EightWords>(patterns.place[hit]);
    const Integers places = __builtin_convertvector(lanes, Integers) + first;
    std::memcpy(out, &places, sizeof places);
    return out + patterns.count[hit];
}
std::uint16_t* append_points(std::size_t hit, const std::int32_t* chunk, std::uint16_t* out)
{
    const EightWords places =
        load<EightWords>(patterns.place[hit]) + static_cast<std::uint16_t>(chunk_slots * *chunk);
    std::memcpy(out, &places, sizeof places);
    return out + patterns.count[hit];
}
#endif

// Writes the chunks within the radius of a point, and behind them the index of a padding chunk.
std::int32_t* find_chunks(const Candidates& all, const float* at, float limit, std::int32_t* out)
{
    for (std::int32_t chunk = 0; chunk < all.chunks; chunk += width) {
        Floats squared{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Floats below = load<Floats>((&all.low[0])[axis] + chunk) - at[axis];
            const Floats above = at[axis] - load<Floats>((&all.high[0])[axis] + chunk);
            const Floats gap = larger(larger(below, above), Floats{});
            squared += gap * gap;
        }
        out = append_chunks(within(squared, limit), chunk, out);
    }
    *out = all.chunks;
    return out;
}

std::size_t filter(const Candidates& all, const std::array<float, 3>& point, float radius,
                   std::int32_t* near, std::uint16_t* number)
{
    const float limit = radius * radius;
    const float* const at = &point[0];
    const std::int32_t* const end = find_chunks(all, at, limit, near);
    std::uint16_t* out = number;
    for (; near < end; near += width / chunk_slots) {
        Floats squared{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Floats way = load_chunks((&all.points[0])[axis], near) - at[axis];
            squared += way * way;
        }
        out = append_points(within(squared, limit), near, out);
    }
    return static_cast<std::size_t>(out - number);
}

} // namespace

template <>
const ListLoops* list_loops<bytes>()
{
    static constexpr ListLoops loops{filter};
    return &loops;
}

} // namespace hyoryu
