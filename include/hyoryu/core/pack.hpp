// SPDX-License-Identifier: MIT
// Packs of numbers (SIMD vectors), so that the formula of a pair term is written once and serves
// the scalar reference and the vector loops of every instruction set.
#pragma once

#include "hyoryu/core/types.hpp"

#include <cmath>
#include <utility>

namespace hyoryu {

/// As many numbers T as fill a register of `bytes` bytes; arithmetic works lane by lane (vector
/// extensions of GCC and Clang). The size is part of the type, so that code compiled for one
/// instruction set shares no function with another.
template <class T, int bytes>
struct Pack {
    static constexpr int lanes = bytes / static_cast<int>(sizeof(T));
    typedef T Register __attribute__((vector_size(bytes)));
    Register value{};

    Pack() = default;
    Pack(const Register& lanes_) : value(lanes_) {}
    /// The same value in every lane. Parameters are double; a pack of floats rounds them once.
    Pack(double all) : value(Register{} + static_cast<T>(all)) {}

    T operator[](int lane) const { return value[lane]; }

    friend Pack operator+(const Pack& a, const Pack& b) { return a.value + b.value; }
    friend Pack operator-(const Pack& a, const Pack& b) { return a.value - b.value; }
    friend Pack operator*(const Pack& a, const Pack& b) { return a.value * b.value; }
    friend Pack operator/(const Pack& a, const Pack& b) { return a.value / b.value; }
    friend Pack operator-(const Pack& a) { return -a.value; }
    Pack& operator+=(const Pack& b)
    {
        value += b.value;
        return *this;
    }
};

inline double square_root(double x)
{
    return std::sqrt(x);
}
template <class T, int bytes>
Pack<T, bytes> square_root(const Pack<T, bytes>& x)
{
    Pack<T, bytes> root;
    for (int k = 0; k < Pack<T, bytes>::lanes; ++k) {
        root.value[k] = std::sqrt(x.value[k]);
    }
    return root;
}

/// max(x, 0), lane by lane.
inline double positive(double x)
{
    return x > 0 ? x : 0;
}
template <class T, int bytes>
Pack<T, bytes> positive(const Pack<T, bytes>& x)
{
    return x.value > 0 ? x.value : typename Pack<T, bytes>::Register{};
}

/// min(x, 0), lane by lane.
inline double negative(double x)
{
    return x < 0 ? x : 0;
}
template <class T, int bytes>
Pack<T, bytes> negative(const Pack<T, bytes>& x)
{
    return x.value < 0 ? x.value : typename Pack<T, bytes>::Register{};
}

/// `value` where `test` is positive and 0 elsewhere, lane by lane.
inline double where_positive(double test, double value)
{
    return test > 0 ? value : 0;
}
template <class T, int bytes>
Pack<T, bytes> where_positive(const Pack<T, bytes>& test, const Pack<T, bytes>& value)
{
    return test.value > 0 ? value.value : typename Pack<T, bytes>::Register{};
}

namespace detail {

/// Adds the second half of the lanes to the first until one lane is left.
template <int lanes>
double sum_of_halves(const auto& x)
{
    if constexpr (lanes == 1) {
        return x[0];
    } else if constexpr (lanes == 2) {
        return x[0] + x[1];
    } else {
        const auto half = [&]<int... lane>(std::integer_sequence<int, lane...>)
        {
            return __builtin_shufflevector(x, x, lane...) +
                   __builtin_shufflevector(x, x, (lane + lanes / 2)...);
        }
        (std::make_integer_sequence<int, lanes / 2>{});
        return sum_of_halves<lanes / 2>(half);
    }
}

} // namespace detail

/// Sum over the lanes in double, in a fixed order.
inline double lane_sum(double x)
{
    return x;
}
template <class T, int bytes>
double lane_sum(const Pack<T, bytes>& x)
{
    constexpr int lanes = Pack<T, bytes>::lanes;
    using Doubles = typename Pack<double, lanes* static_cast<int>(sizeof(double))>::Register;
    return detail::sum_of_halves<lanes>(__builtin_convertvector(x.value, Doubles));
}

} // namespace hyoryu
