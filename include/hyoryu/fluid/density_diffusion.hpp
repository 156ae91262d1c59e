// SPDX-License-Identifier: MIT
// Density diffusion: smooths the acoustic noise of the weakly compressible pressure.
#pragma once

#include "hyoryu/core/sweep.hpp"
#include "hyoryu/fluid/parameters.hpp"

namespace hyoryu {

/// D_i = -2 delta h c0 sum_j V_j [(rho_j - rho_i) - rhoH_ji] F(r), rhoH_ji = (rho0/c0^2) g . (r_j -
/// r_i): only the part of the density difference that is not hydrostatic diffuses. Without
/// `hydrostatic` (g = 0 here) it is the term of Molteni & Colagrossi (2009), which sinks still
/// water. Source: Fourtakas, Dominguez, Vacondio & Rogers (2019), linear equation of state.
struct DensityDiffusion {
    static constexpr std::string_view name = "density_diffusion";
    using Reads = Fields<Volume, Pressure>;
    using Writes = Fields<DiffusionRate>;
    real strength = 0;         // 2 delta h c0 [m2/s]
    EquationOfState eos;       // rho from p
    Vec3 hydrostatic{0, 0, 0}; // (rho0/c0^2) g [kg/m4]

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        const N difference =
            (j[field::pressure] - i[field::pressure]) * (1 / sq(eos.c0)) + dot(hydrostatic, ij.r);
        sum[field::diffusion_rate] += -strength * j[field::volume] * difference * ij.f;
    }
};

} // namespace hyoryu
