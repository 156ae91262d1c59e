// SPDX-License-Identifier: MIT
// Compiled once for each instruction set.
#include "../list_loops.hpp"

#include <cstring>

namespace hyoryu {

namespace {

constexpr int bytes = HYORYU_REGISTER_BYTES;

// Eight points at a time, whatever the registers: a chunk.
using Floats = float __attribute__((vector_size(32)));
using Words = std::uint16_t __attribute__((vector_size(16)));
using Bytes = std::int8_t __attribute__((vector_size(8)));

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

// One bit a lane that is true: bytes of ones, of which byte k keeps bit k, gathered in the top
// byte.
std::size_t bits(decltype(Floats{} < Floats{}) test)
{
    const Bytes narrow = __builtin_convertvector(test, Bytes);
    std::uint64_t ones;
    std::memcpy(&ones, &narrow, sizeof ones);
    return (ones & 0x8040201008040201u) * 0x0101010101010101u >> 56;
}

float squared_gap(const ChunkBox& a, const ChunkBox& b)
{
    float sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float over = b.low[axis] - a.high[axis];
        const float under = a.low[axis] - b.high[axis];
        const float gap = over > under ? over : under;
        sum += gap > 0 ? gap * gap : 0;
    }
    return sum;
}

int filter(const Candidates& all, const Seekers& points, float radius, int lanes,
           std::int32_t* near, std::uint16_t* entry, std::uint16_t* packs)
{
    const float limit = radius * radius;
    int count_near = 0;
    for (std::int32_t chunk = 0; chunk < all.chunks; ++chunk) {
        near[count_near] = chunk;
        count_near += squared_gap(points.box, all.box[chunk]) <= limit ? 1 : 0;
    }
    const auto nothing = static_cast<std::uint16_t>(all.chunks * chunk_slots);
    std::uint16_t* out = entry;
    for (int k = 0; k < points.count; ++k) {
        std::uint16_t* const begin = out;
        const Floats px = Floats{} + points.x[k];
        const Floats py = Floats{} + points.y[k];
        const Floats pz = Floats{} + points.z[k];
        for (int c = 0; c < count_near; ++c) {
            const std::int32_t first = near[c] * chunk_slots;
            const Floats dx = load(all.x + first) - px;
            const Floats dy = load(all.y + first) - py;
            const Floats dz = load(all.z + first) - pz;
            const std::size_t hits = bits(dx * dx + dy * dy + dz * dz <= limit);
            // Eight places are written, the end moves on by the hits.
            Words places;
            std::memcpy(&places, patterns.place[hits], sizeof places);
            places += static_cast<std::uint16_t>(first);
            std::memcpy(out, &places, sizeof places);
            out += patterns.count[hits];
        }
        while ((out - begin) % lanes != 0) {
            *out++ = nothing;
        }
        packs[k] = static_cast<std::uint16_t>((out - begin) / lanes);
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
