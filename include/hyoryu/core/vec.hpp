// SPDX-License-Identifier: MIT
// Numbers side by side (Pack) and small vectors of any number (Vec), so that the formula of a pair
// term is written once and serves the scalar reference and the vector loop.
#pragma once

#include "hyoryu/core/types.hpp"

#include <cmath>
#include <type_traits>

namespace hyoryu {

/// Lanes of a pack. Four doubles fill one AVX register; other targets split or pair them.
inline constexpr int lanes = 4;

/// `lanes` reals side by side; arithmetic and comparison work lane by lane (GCC and Clang vectors).
using Pack = real __attribute__((vector_size(lanes * sizeof(real))));

template <class N>
inline constexpr bool is_pack = std::is_same_v<N, Pack>;

/// The same value in every lane, or the value itself.
template <class N>
constexpr N broadcast(real value)
{
    if constexpr (is_pack<N>) {
        return N{value, value, value, value};
    } else {
        return value;
    }
}

inline real square_root(real x)
{
    return std::sqrt(x);
}
inline Pack square_root(const Pack& x)
{
    return Pack{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
}

/// max(x, 0), lane by lane.
inline real positive(real x)
{
    return x > 0 ? x : 0;
}
inline Pack positive(const Pack& x)
{
    return x > 0 ? x : Pack{};
}

/// min(x, 0), lane by lane.
inline real negative(real x)
{
    return x < 0 ? x : 0;
}
inline Pack negative(const Pack& x)
{
    return x < 0 ? x : Pack{};
}

/// `value` where `test` is positive and 0 elsewhere, lane by lane.
inline real where_positive(real test, real value)
{
    return test > 0 ? value : 0;
}
inline Pack where_positive(const Pack& test, const Pack& value)
{
    return test > 0 ? value : Pack{};
}

/// Sum over the lanes in a fixed order.
inline real lane_sum(real x)
{
    return x;
}
inline real lane_sum(const Pack& x)
{
    return (x[0] + x[1]) + (x[2] + x[3]);
}

/// A vector of three numbers N.
template <class N>
struct Vec {
    N x{}, y{}, z{};
};

template <class N>
constexpr Vec<N> operator+(const Vec<N>& a, const Vec<N>& b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class N>
constexpr Vec<N> operator-(const Vec<N>& a, const Vec<N>& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class N>
constexpr Vec<N> operator*(const std::type_identity_t<N>& s, const Vec<N>& a)
{
    return {s * a.x, s * a.y, s * a.z};
}
template <class N>
constexpr Vec<N>& operator+=(Vec<N>& a, const Vec<N>& b)
{
    return a = a + b;
}
template <class N>
constexpr N dot(const Vec<N>& a, const Vec<N>& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// A constant vector as lanes see it.
template <class N>
constexpr Vec<N> broadcast(const Vec3& a)
{
    return {broadcast<N>(a.x()), broadcast<N>(a.y()), broadcast<N>(a.z())};
}
/// dot product with a constant vector.
template <class N>
constexpr N dot(const Vec3& a, const Vec<N>& b)
{
    return a.x() * b.x + a.y() * b.y + a.z() * b.z;
}

inline Vec3 lane_sum(const Vec<real>& a)
{
    return {a.x, a.y, a.z};
}
inline Vec3 lane_sum(const Vec<Pack>& a)
{
    return {lane_sum(a.x), lane_sum(a.y), lane_sum(a.z)};
}

} // namespace hyoryu
