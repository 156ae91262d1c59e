// SPDX-License-Identifier: MIT
#include "hyoryu/fluid/mps.hpp"

#include "moments.hpp"

#include <algorithm>

namespace hyoryu {

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
        const real b = inner_share(M);
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
