// SPDX-License-Identifier: MIT
// Transposes records to packs: reads the records of one point per lane and returns one pack per
// field. Uses loads of 16 or 32 bytes and shuffles; a gather instruction costs several times as
// much.
#pragma once

#include "hyoryu/core/pack.hpp"
#include "hyoryu/core/records.hpp"

#include <cstring>
#include <utility>

namespace hyoryu::detail {

/// The fields of List from the numbers get(0), get(1), ...
template <class List, class N>
Record<List, N> assemble(const auto& get)
{
    Record<List, N> record;
    for_each(List{}, [&](auto field) {
        constexpr int at = offset<decltype(field), List>;
        if constexpr (width<decltype(field)> == 3) {
            record[field] = {get(at), get(at + 1), get(at + 2)};
        } else {
            record[field] = get(at);
        }
    });
    return record;
}

template <int bytes, class Real>
typename Pack<Real, bytes>::Register load_register(const Real* from)
{
    typename Pack<Real, bytes>::Register lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
}

/// Concatenates get(0), get(1), ..., `part` bytes each, to one register.
template <class Real, int bytes, int part, int first = 0>
typename Pack<Real, bytes>::Register join(const auto& get)
{
    if constexpr (bytes == part) {
        return get(first);
    } else {
        const auto low = join<Real, bytes / 2, part, first>(get);
        const auto high = join<Real, bytes / 2, part, first + bytes / 2 / part>(get);
        return [&]<int... lane>(std::integer_sequence<int, lane...>)
        {
            return __builtin_shufflevector(low, high, lane...);
        }
        (std::make_integer_sequence<int, Pack<Real, bytes>::lanes>{});
    }
}

/// Picks numbers within quads: in each quad (16 bytes) the numbers `pick` of the quads of a and b.
template <int... pick, class Register>
Register shuffle(const Register& a, const Register& b)
{
    constexpr int quad = sizeof...(pick);
    constexpr int lanes = sizeof(Register) / sizeof(a[0]);
    constexpr int picks[] = {pick...};
    constexpr auto source = [](int lane) {
        const int p = picks[lane % quad];
        return lane / quad * quad + (p < quad ? p : p - quad + lanes);
    };
    return [&]<int... lane>(std::integer_sequence<int, lane...>)
    {
        return __builtin_shufflevector(a, b, source(lane)...);
    }
    (std::make_integer_sequence<int, lanes>{});
}

/// Picks whole quads: the quads `pick` of a and b, those of b numbered behind those of a.
template <int... pick, class Register>
Register shuffle_quads(const Register& a, const Register& b)
{
    constexpr int lanes = sizeof(Register) / sizeof(a[0]);
    constexpr int quad = lanes / static_cast<int>(sizeof...(pick));
    constexpr int picks[] = {pick...};
    return [&]<int... lane>(std::integer_sequence<int, lane...>)
    {
        return __builtin_shufflevector(a, b, (picks[lane / quad] * quad + lane % quad)...);
    }
    (std::make_integer_sequence<int, lanes>{});
}

/// Transposes each quad: number k of register m comes from number m of register k.
template <class Register>
void transpose_within_quads(const Register* in, Register* out)
{
    if constexpr (sizeof((*in)[0]) == 8) {
        out[0] = shuffle<0, 2>(in[0], in[1]);
        out[1] = shuffle<1, 3>(in[0], in[1]);
    } else {
        const Register ab_low = shuffle<0, 4, 1, 5>(in[0], in[1]);
        const Register ab_high = shuffle<2, 6, 3, 7>(in[0], in[1]);
        const Register cd_low = shuffle<0, 4, 1, 5>(in[2], in[3]);
        const Register cd_high = shuffle<2, 6, 3, 7>(in[2], in[3]);
        out[0] = shuffle<0, 1, 4, 5>(ab_low, cd_low);
        out[1] = shuffle<2, 3, 6, 7>(ab_low, cd_low);
        out[2] = shuffle<0, 1, 4, 5>(ab_high, cd_high);
        out[3] = shuffle<2, 3, 6, 7>(ab_high, cd_high);
    }
}

/// Transposes one quad of as many rows as a pack has lanes; row k goes to lane k.
template <int bytes, class Real>
void transpose_quad(const auto& row, Pack<Real, bytes>* out)
{
    using Register = typename Pack<Real, bytes>::Register;
    constexpr int quad = 16 / sizeof(Real);
    Register rows[quad], columns[quad];
    for (int k = 0; k < quad; ++k) {
        rows[k] = join<Real, bytes, 16>(
            [&](int part) { return load_register<16>(row(k + quad * part)); });
    }
    transpose_within_quads(rows, columns);
    for (int k = 0; k < quad; ++k) {
        out[k] = columns[k];
    }
}

/// The same for two quads at once in registers of 64 bytes: half the loads and a fifth fewer
/// shuffles. The rows are permuted among the lanes, alike for both quads; sums over the lanes do
/// not depend on the permutation.
template <class Real>
void transpose_two_quads(const auto& row, Pack<Real, 64>* out)
{
    using Register = typename Pack<Real, 64>::Register;
    constexpr int quad = 16 / sizeof(Real);
    Register rows[2 * quad], columns[2 * quad];
    for (int k = 0; k < 2 * quad; ++k) {
        rows[k] = join<Real, 64, 32>(
            [&](int part) { return load_register<32>(row(k + 2 * quad * part)); });
    }
    transpose_within_quads(rows, columns);
    transpose_within_quads(rows + quad, columns + quad);
    for (int k = 0; k < quad; ++k) {
        out[k] = shuffle_quads<0, 2, 4, 6>(columns[k], columns[k + quad]);
        out[k + quad] = shuffle_quads<1, 3, 5, 7>(columns[k], columns[k + quad]);
    }
}

/// Loads one record per lane; a lane holds the same record for every field. `at` advances by one
/// step for each lane. The steps are added by scalar units, which are idle while the vector units
/// are busy.
template <int bytes, class List, class Real>
Record<List, Pack<Real, bytes>> gather(const RecordRow<List, Real>*& at, const std::uint8_t* step)
{
    using Row = RecordRow<List, Real>;
    constexpr int at_once = bytes == 64 && Row::quads % 2 == 0 ? 2 : 1;
    const Row* rows[Pack<Real, bytes>::lanes];
    for (const Row*& row : rows) {
        at += *step++;
        row = at;
    }
    Pack<Real, bytes> flat[Row::size];
    for (int q = 0; q < Row::quads; q += at_once) {
        const auto row = [&](int lane) { return &rows[lane]->value[q * Row::quad]; };
        if constexpr (at_once == 2) {
            transpose_two_quads<Real>(row, flat + q * Row::quad);
        } else {
            transpose_quad<bytes>(row, flat + q * Row::quad);
        }
    }
    return assemble<List, Pack<Real, bytes>>([&](int k) { return flat[k]; });
}

} // namespace hyoryu::detail
