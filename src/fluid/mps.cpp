// SPDX-License-Identifier: MIT
#include "hyoryu/fluid/mps.hpp"

#include "moments.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace hyoryu {

namespace {

// Least eigenvalues of the moments at which the correction begins and is whole: 1 inside, about one
// half on a flat surface.
constexpr real surface = 0.8;
constexpr real inside = 0.95;

// How much of the corrected gradient is used, 0 to 1.
real corrected_share(const Mat3& M)
{
    Eigen::SelfAdjointEigenSolver<Mat3> solver;
    solver.computeDirect(M, Eigen::EigenvaluesOnly);
    const real least = solver.eigenvalues().minCoeff();
    return std::clamp((least - surface) / (inside - surface), real(0), real(1));
}

} // namespace

void add_corrected_pressure(const FluidParameters& fluid, Store& store)
{
    const auto p = store[field::pressure];
    const auto V = store[field::volume];
    const auto G = store[field::pressure_gradient];
    const auto S = store[field::crowding_gradient];
    const auto moments = store[field::moments];
    const auto mixed = store[field::mixed_moments];
    const auto F = store[field::force];
    parallel_for(0, store.size(), [&](Index i) {
        const Mat3 M = moment_matrix(moments[i], mixed[i], fluid.dimensions);
        const real b = corrected_share(M);
        Vec3 gradient = (1 - b) * (G[i] + 2 * p[i] * S[i]);
        if (b > 0) {
            const Vec3 corrected = M.inverse() * G[i];
            const real push = std::clamp(p[i], real(0), fluid.spacing * corrected.norm());
            gradient += b * (corrected + push * S[i]);
        }
        F[i] -= V[i] * gradient;
    });
}

} // namespace hyoryu
