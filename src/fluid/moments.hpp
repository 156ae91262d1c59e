// SPDX-License-Identifier: MIT
// The matrix of second moments by which a gradient is corrected.
#pragma once

#include "hyoryu/core/types.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace hyoryu {

/// M = -sum V F r r^T from its sums; regular across a plane of two dimensions.
inline Mat3 moment_matrix(const Vec3& moments, const Vec3& mixed, int dimensions)
{
    Mat3 M = moments.asDiagonal();
    M(1, 2) = M(2, 1) = mixed[0];
    M(0, 2) = M(2, 0) = mixed[1];
    M(0, 1) = M(1, 0) = mixed[2];
    if (dimensions == 2) {
        M(1, 1) = 1;
    }
    return M;
}

/// How far inside the fluid a particle of these moments is, 0 to 1: by their least eigenvalue,
/// which is 1 inside and about one half on a flat surface.
inline real inner_share(const Mat3& M)
{
    constexpr real surface = 0.8;
    constexpr real inside = 0.95;
    Eigen::SelfAdjointEigenSolver<Mat3> solver;
    solver.computeDirect(M, Eigen::EigenvaluesOnly);
    const real least = solver.eigenvalues().minCoeff();
    return std::clamp((least - surface) / (inside - surface), real(0), real(1));
}

} // namespace hyoryu
