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

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

inline constexpr double infinity = std::numeric_limits<double>::infinity();

template <class T>
constexpr T sq(const T& x)
{
    return x * x;
}

} // namespace hyoryu
