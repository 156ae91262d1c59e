// SPDX-License-Identifier: MIT
// Pressure forces between particles, momentum-conserving form.
#pragma once

#include "hyoryu/core/sweep.hpp"

namespace hyoryu {

/// F_i = -sum_j V_i V_j (p_i + p_j) F(r) r: the symmetric gradient, exact in linear momentum.
/// Source: Colagrossi & Landrini (2003); with V = m/rho it is the form of Monaghan (2005), sec. 3.
struct PressureForce {
    static constexpr std::string_view name = "pressure";
    using Reads = Fields<Volume, Pressure>;
    using Writes = Fields<Force>;

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        sum[field::force] += -(i[field::volume] * j[field::volume]) *
                             (i[field::pressure] + j[field::pressure]) * ij.f * ij.r;
    }
};

/// The same between a fluid and a solid particle or between particles of two solids, only where
/// both are under pressure. Pulling would draw isolated droplets of rho < rho0 into the wall, the
/// measured cause of leaks; and wall particles above a free surface, to which the extrapolation
/// gives no pressure, would push the fluid beside the wall down and set still water into motion.
struct WallPressureForce {
    static constexpr std::string_view name = "wall_pressure";
    using Reads = Fields<Volume, Pressure>;
    using Writes = Fields<Force>;

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        const N p_i = positive(i[field::pressure]);
        const N p_j = positive(j[field::pressure]);
        const N push = where_positive(N(p_i * p_j), N(p_i + p_j));
        sum[field::force] += -(i[field::volume] * j[field::volume]) * push * ij.f * ij.r;
    }
};

} // namespace hyoryu
