// SPDX-License-Identifier: MIT
// Separation of fluid from solids without tension: the fluid is neither pulled nor stretched.
//
// Force and rate of density of a pair belong together: only with both does the work of the pressure
// equal the change of the energy of compression. Solids push but do not pull (`WallPressureForce`),
// so fluid without pressure must not be stretched either as it leaves a solid: it would gain a
// tension for which no force has done work. The density that it keeps instead is its gap. Fluid
// with a gap does not touch the solids: they exert no pressure on it, and when it approaches them
// the gap closes before the fluid is compressed.
#pragma once

#include "hyoryu/fluid/continuity.hpp"

#include <algorithm>

namespace hyoryu {

/// Contribution of nearby solids to the continuity of a fluid particle, R_s = sum_s V_s (v_i -
/// v_s).r F [1/s], times rho_i a rate of density: the pair of `Continuity` in a sum of its own. And
/// sum_s W [1/m^d], by which is known how near they are. Ours; no published source.
struct SolidContinuity {
    static constexpr std::string_view name = "solid_continuity";
    using Reads = Fields<Velocity, Volume>;
    using Writes = Fields<SolidRate, ShepardSum>;

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        sum[field::solid_rate] += continuity_of_pair(ij, i, j);
        sum[field::shepard_sum] += ij.w;
    }
};

/// The part of a change of density due to solids [kg/m3] that goes to the gap instead, at most all
/// of it. Negative if the change closes the gap; positive if it would stretch a particle that has a
/// gap already or whose density is lower than at rest by `below`.
inline real to_gap(real gap, real change, real below)
{
    if (change > 0) {
        return -std::min(gap, change);
    }
    return gap > 0 ? -change : std::clamp(below, real(0), -change);
}

/// sum W over the solid half of the lattice about a particle at rest beside a plane wall, half a
/// spacing from it [1/m^d]. Particles nearer to solids have no gap.
template <class AnyKernel>
real sum_beside_plane(const AnyKernel& kernel, real spacing, int dimensions)
{
    const int reach = static_cast<int>(kernel.support / spacing) + 1;
    const int across = dimensions == 3 ? reach : 0;
    real sum = 0;
    for (int x = -reach; x <= reach; ++x) {
        for (int y = -across; y <= across; ++y) {
            for (int z = 1; z <= reach; ++z) {
                sum += kernel(Vec<real>{x * spacing, y * spacing, z * spacing}).w;
            }
        }
    }
    return sum;
}

} // namespace hyoryu
