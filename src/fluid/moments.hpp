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

/// Whether all eigenvalues of a symmetric matrix are above a bound: Sylvester's criterion.
inline bool is_above(const Mat3& M, real bound)
{
    const Mat3 A = M - bound * Mat3::Identity();
    return A(0, 0) > 0 && A(0, 0) * A(1, 1) > A(0, 1) * A(0, 1) && A.determinant() > 0;
}

/// Where the least eigenvalue of M lies from `surface`, 0, to `inside`, 1: inside the fluid it is
/// 1, on a flat surface about one half. The eigenvalue is computed only for the few particles in
/// between.
inline real share_between(const Mat3& M, real surface, real inside)
{
    if (!is_above(M, surface)) {
        return 0;
    }
    if (is_above(M, inside)) {
        return 1;
    }
    Eigen::SelfAdjointEigenSolver<Mat3> solver;
    solver.computeDirect(M, Eigen::EigenvaluesOnly);
    const real least = solver.eigenvalues().minCoeff();
    return std::clamp((least - surface) / (inside - surface), real(0), real(1));
}

} // namespace hyoryu
