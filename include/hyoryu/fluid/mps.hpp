// SPDX-License-Identifier: MIT
// The pressure gradient of weakly compressible MPS: of differences, and corrected.
#pragma once

#include "hyoryu/core/sweep.hpp"
#include "hyoryu/fluid/moment_sum.hpp"
#include "hyoryu/fluid/parameters.hpp"

namespace hyoryu {

/// The sums of which `corrected_pressure_force` makes a force:
/// G_i = sum_j V_j (p_j - p_i) F r, S_i = sum_j V_j F r, M_i = -sum_j V_j F r r^T.
/// Source: the difference form of Koshizuka & Oka (1996), eq. 8, with p_i in the place of the least
/// pressure about i.
struct MpsGradient {
    static constexpr std::string_view name = "mps_pressure";
    using Reads = Fields<Volume, Pressure>;
    using Writes = Fields<PressureGradient, CrowdingGradient, Moments, MixedMoments>;

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        add(ij, N(j[field::volume] * ij.f), N(j[field::pressure] - i[field::pressure]), sum);
    }

    /// One pair of weight V_j F.
    template <class N>
    static void add(const Pair<N>& ij, const N& weight, const N& difference, auto& sum)
    {
        const Vec<N> step = weight * ij.r;
        sum[field::pressure_gradient] += difference * step;
        sum[field::crowding_gradient] += step;
        add_moments(step, ij.r, sum);
    }
};

/// The same of a fluid particle and solid ones, only where both are under pressure: a solid above
/// the surface has none, and the correction makes the rest a gradient of one side.
struct MpsWallGradient {
    static constexpr std::string_view name = "mps_wall_pressure";
    using Reads = Fields<Volume, Pressure>;
    using Writes = MpsGradient::Writes;

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        const N both = positive(i[field::pressure]) * positive(j[field::pressure]);
        const N weight = where_positive(both, N(j[field::volume] * ij.f));
        MpsGradient::add(ij, weight, N(j[field::pressure] - i[field::pressure]), sum);
    }
};

/// F_i -= V_i [b (M_i^-1 G_i + q_i S_i) + (1 - b) (G_i + 2 p_i S_i)] for every fluid particle.
/// Inside, b = 1: the gradient of a linear pressure is exact wherever the particles are, and the
/// push q_i = min(p_i, dp |M_i^-1 G_i|), at least 0, up to which the pressure about i is lower
/// than at i, keeps them apart, as the least pressure about i does in MPS. Near the surface, where
/// the least eigenvalue of M_i falls from 0.95 to 0.8, b goes to 0 and the symmetric form of the
/// SPH loops remains: corrected there, the gradient is not the adjoint of the divergence and
/// sound grows. Source: Khayyer & Gotoh (2011), corrective matrix; Tamai & Koshizuka (2014).
void add_corrected_pressure(const FluidParameters& fluid, Store& store);

} // namespace hyoryu
