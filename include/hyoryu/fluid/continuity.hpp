// SPDX-License-Identifier: MIT
// Conservation of mass.
#pragma once

#include "hyoryu/core/sweep.hpp"

namespace hyoryu {

/// V_j (v_i - v_j) . r F(r), the contribution of neighbour j to the density rate of i [1/s].
template <class N>
N continuity_of_pair(const Pair<N>& ij, const auto& i, const auto& j)
{
    return j[field::volume] * dot(i[field::velocity] - j[field::velocity], ij.r) * ij.f;
}

/// sum_j V_j (v_i - v_j) . r F(r); times rho_i it is d(rho_i)/dt. Source: Monaghan (2005), eq. 2.18
/// in the volume form of Colagrossi & Landrini (2003).
struct Continuity {
    static constexpr std::string_view name = "continuity";
    using Reads = Fields<Velocity, Volume>;
    using Writes = Fields<DensityRate>;

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        sum[field::density_rate] += continuity_of_pair(ij, i, j);
    }
};

} // namespace hyoryu
