// SPDX-License-Identifier: MIT
// Generalised wall particles: a solid particle takes over the pressure of the fluid before it.
#pragma once

#include "hyoryu/core/sweep.hpp"
#include "hyoryu/fluid/parameters.hpp"

namespace hyoryu {

/// Sums of p_w = sum_f [p_f + rho_f g . (r_w - r_f)] W / sum_f W.
/// Source: Adami, Hu & Adams (2012), eq. 27. The acceleration of the wall is left out: for free
/// bodies that feedback is unstable at any time step.
struct WallExtrapolation {
    static constexpr std::string_view name = "wall_extrapolation";
    using Reads = Fields<Pressure>;
    using Writes = Fields<ShepardSum, Pressure>; // the sum, until it is divided
    EquationOfState eos;
    Vec3 gravity{0, 0, -9.81}; // [m/s2]

    template <class N>
    void operator()(const Pair<N>& ij, const auto&, const auto& j, auto& sum) const
    {
        const N rho = eos.density(j[field::pressure]);
        sum[field::shepard_sum] += ij.w;
        sum[field::pressure] += (j[field::pressure] + rho * dot(gravity, ij.r)) * ij.w;
    }
};

/// A fluid and a solid particle closer than one spacing and still approaching exchange the impulse
/// that stops (part of) their approach, as if both had the mass of a fluid particle:
/// F_i = -m/(2 dt) kappa min(v.r, 0)/r^2 r, kappa = 1 for r < dp/2 and falling to 0 at dp.
/// Pairwise, so momentum is conserved and the body feels the reaction.
/// Source: Jandaghian, Krimi & Shakibaeinia (2021), dynamic particle collision, e = 0.
struct SolidBackstop {
    static constexpr std::string_view name = "solid_backstop";
    using Reads = Fields<Velocity>;
    using Writes = Fields<Force>;
    real spacing = 0;       // dp [m]
    real mass_per_step = 0; // m / (2 dt) [kg/s]

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        const N s = ij.distance * (1 / spacing);
        const N gap = positive(N(1 - s));
        // sqrt(w(s)/w(1/2)), w = (1 - s)^4 (4 s + 1), w(1/2) = 3/16; at most 1
        const N chi = sq(gap) * square_root(N((4 * s + 1) * (16.0 / 3.0)));
        const N kappa = 1 - positive(N(1 - chi));
        const N approach = negative(dot(i[field::velocity] - j[field::velocity], ij.r));
        const N tiny = 1e-12 * sq(spacing); // coincident centres: no direction, no force
        sum[field::force] +=
            -mass_per_step * kappa * approach / (ij.distance_squared + tiny) * ij.r;
    }
};

} // namespace hyoryu
