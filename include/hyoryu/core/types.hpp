// SPDX-License-Identifier: MIT
// Number and vector types of all layers, and general constants.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <limits>

namespace hyoryu {

/// The number of particle state and pair arithmetic. Rigid-body state is `double` whatever this is.
using real = double;

/// Rows, counts and indices: signed, so that differences are harmless.
using Index = std::ptrdiff_t;

/// A row, count or index as the containers of the standard library take it.
constexpr std::size_t at(Index k)
{
    return static_cast<std::size_t>(k);
}

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

inline constexpr double infinity = std::numeric_limits<double>::infinity();
/// Stands for a value that there is not.
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <class T>
constexpr T sq(const T& x)
{
    return x * x;
}

} // namespace hyoryu
