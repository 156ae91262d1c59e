// SPDX-License-Identifier: MIT
// Small vectors of any number: one real, or a pack of them.
#pragma once

#include "hyoryu/core/pack.hpp"

#include <type_traits>

namespace hyoryu {

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

/// dot product with a constant vector.
template <class N>
constexpr N dot(const Vec3& a, const Vec<N>& b)
{
    return a.x() * b.x + a.y() * b.y + a.z() * b.z;
}

} // namespace hyoryu
