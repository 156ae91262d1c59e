// SPDX-License-Identifier: MIT
// Viscosity in the pair form of Monaghan & Gingold, artificial and laminar alike.
#pragma once

#include "hyoryu/fluid/stage.hpp"

namespace hyoryu {

/// F_i = sum_j V_i V_j rho0 kappa (v_i - v_j).r / (r^2 + 0.01 h^2) F(r) r,
/// kappa = alpha h c0 + 2 (d + 2) nu [m2/s]: acts along the line of centres, so it conserves
/// angular momentum, and it is consistent at a free surface, where the Morris form loses half the
/// dissipation (Colagrossi, Antuono, Souto-Iglesias & Le Touze 2011). Source: Monaghan & Gingold
/// (1983); equivalence nu = alpha h c0 / (2 (d + 2)): Monaghan (2005), sec. 8.
struct Viscosity {
    static constexpr std::string_view name = "viscosity";
    using Stage = stage::Rates;
    using Reads = Fields<Velocity, Volume>;
    using Writes = Fields<ViscousForce>;
    real rho0 = 1000; // [kg/m3]
    real kappa = 0;   // [m2/s]
    real h = 1;       // [m]

    Viscosity at_wall() const { return *this; }

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        const N approach = dot(i[field::velocity] - j[field::velocity], ij.r);
        const N mu = rho0 * kappa * approach / (ij.distance_squared + 0.01 * sq(h));
        sum[field::viscous_force] += (i[field::volume] * j[field::volume]) * mu * ij.f * ij.r;
    }
};

/// F_i = 2 rho0 nu sum_j V_i V_j F(r) (v_i - v_j): the Laplacian of the velocity. On a lattice that
/// shears along its rows it is exact, where the central form above has 88 to 91 % of its viscosity
/// at h = 1.5 dp; at a free surface it loses half of the dissipation, and it does not conserve
/// angular momentum: for flows between walls. Source: Morris, Fox & Zhu (1997), eq. 22.
struct MorrisViscosity {
    static constexpr std::string_view name = "morris_viscosity";
    using Stage = stage::Rates;
    using Reads = Fields<Velocity, Volume>;
    using Writes = Fields<ViscousForce>;
    real mu = 0; // rho0 nu [Pa s]

    MorrisViscosity at_wall() const { return *this; }

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        sum[field::viscous_force] += (i[field::volume] * j[field::volume]) * (2 * mu) * ij.f *
                                     (i[field::velocity] - j[field::velocity]);
    }
};

/// kappa of the artificial viscosity alpha [1].
inline real artificial_kappa(real alpha, real h, real c0)
{
    return alpha * h * c0;
}
/// kappa of the kinematic viscosity nu [m2/s] in d dimensions.
inline real laminar_kappa(real nu, int dimensions)
{
    return 2 * (dimensions + 2) * nu;
}

} // namespace hyoryu
