// SPDX-License-Identifier: MIT
// Fluid parts from solids without being pulled and without being stretched.
//
// Force and rate of density of a pair belong together: only with both does the work of the pressure
// equal the change of the energy of compression. Solids push and do not pull (`WallPressureForce`),
// so what is without pressure must not be stretched as it leaves a solid either: it would carry
// away a tension that no force has worked for. The density that it keeps is its gap. While it has
// one it does not touch the solids: they do not push it, and what brings it nearer to them closes
// the gap before it compresses.
#pragma once

#include "hyoryu/fluid/continuity.hpp"

#include <algorithm>

namespace hyoryu {

/// What the solids about a fluid particle make of its continuity, R_s = sum_s V_s (v_i - v_s).r F
/// [1/s], times rho_i a rate of density: the pair of `Continuity` in a sum of its own. And
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

/// What of a change of density [kg/m3] that solids made goes to the gap instead, at most all of it:
/// negative where the change closes the gap, positive where it would stretch a particle that has a
/// gap already or is `below` its density at rest by so much.
inline real to_gap(real gap, real change, real below)
{
    if (change > 0) {
        return -std::min(gap, change);
    }
    return gap > 0 ? -change : std::clamp(below, real(0), -change);
}

/// sum W over the solid half of the lattice about a particle at rest beside a plane wall, half a
/// spacing from it [1/m^d]. What is so near to solids has no room for a gap.
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
