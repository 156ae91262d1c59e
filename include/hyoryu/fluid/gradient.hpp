// SPDX-License-Identifier: MIT
// The corrected pressure gradient of SPH and the divergence that is its adjoint.
//
// On disordered particles, and beside a bed, the plain gradient of a linear pressure is off by some
// per cent, so that long waves run too fast and bodies feel too little added mass. The reverse
// kernel gradient correction multiplies each pressure by the matrix of the *other* particle, which
// keeps pair forces opposite. The rate of density takes the same matrices, so that the work of
// the pressure is the change of the compression energy.
#pragma once

#include "hyoryu/fluid/moment_sum.hpp"
#include "hyoryu/fluid/parameters.hpp"
#include "hyoryu/fluid/slot.hpp"

namespace hyoryu {

/// C r of a symmetric matrix C, given as xx, yy, zz and yz, xz, xy.
template <class N>
Vec<N> times(const Vec<N>& diagonal, const Vec<N>& mixed, const Vec<N>& r)
{
    return {diagonal.x * r.x + mixed.z * r.y + mixed.y * r.z,
            mixed.z * r.x + diagonal.y * r.y + mixed.x * r.z,
            mixed.y * r.x + mixed.x * r.y + diagonal.z * r.z};
}

/// F_i = -sum_j V_i V_j (p_j B_i + p_i B_j) F r over the fluid, B = 1 + C the correction of
/// `correction`. The sum in the brackets is taken as (p_i + p_j)(1 + (C_i + C_j)/2) - (p_i - p_j)
/// (C_i - C_j)/2, whose parts keep their bits or change sign as i and j change places, also where
/// the compiler contracts a product and a sum. Source: Zhang, Adams & Hu (2024), arXiv 2406.02576,
/// eq. 20.
struct CorrectedGradient {
    static constexpr std::string_view name = "corrected_gradient";
    using Reads = Fields<Volume, Pressure, GradientCorrection, MixedCorrection>;
    using Writes = Fields<Force>;
    using Columns = Union<Writes, Reads, Fields<Moments, MixedMoments, Correction, CorrectionRate>>;

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        const auto& C_i = i[field::gradient_correction];
        const auto& C_j = j[field::gradient_correction];
        const auto& M_i = i[field::mixed_correction];
        const auto& M_j = j[field::mixed_correction];
        const N half_sum = 0.5 * (i[field::pressure] + j[field::pressure]);
        const N half_difference = 0.5 * (i[field::pressure] - j[field::pressure]);
        const Vec<N> mean = 2 * ij.r + times<N>(C_i + C_j, M_i + M_j, ij.r);
        const Vec<N> odd = times<N>(C_i - C_j, M_i - M_j, ij.r);
        sum[field::force] += (-(i[field::volume] * j[field::volume]) * ij.f) *
                             (half_sum * mean - half_difference * odd);
    }
};

/// sum_j V_j (v_i - v_j) . B_j r F over the fluid [1/s]; times rho_i it is d(rho_i)/dt. The adjoint
/// of `CorrectedGradient`: sum_i v_i . F_i = -sum_i p_i V_i (this sum). The sum for r, that of
/// `Continuity`, and the sum for the correction, C_j r, are kept apart. Ours.
struct CorrectedContinuity {
    static constexpr std::string_view name = "corrected_continuity";
    using Reads = Fields<Velocity, Volume, GradientCorrection, MixedCorrection>;
    using Writes = Fields<DensityRate, CorrectionRate>;

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        const Vec<N> r = times<N>(j[field::gradient_correction], j[field::mixed_correction], ij.r);
        const Vec<N> v = i[field::velocity] - j[field::velocity];
        sum[field::density_rate] += (j[field::volume] * ij.f) * dot(v, ij.r);
        sum[field::correction_rate] += (j[field::volume] * ij.f) * dot(v, r);
    }
};

/// M_i = -sum_j V_j F r r^T over fluid and solids: 1 inside a regular lattice.
struct GradientMoments {
    static constexpr std::string_view name = "gradient_moments";
    using Reads = Fields<Volume>;
    using Writes = Fields<Moments, MixedMoments>;

    template <class N>
    void operator()(const Pair<N>& ij, const auto&, const auto& j, auto& sum) const
    {
        add_moments(Vec<N>((j[field::volume] * ij.f) * ij.r), ij.r, sum);
    }
};

/// The share of the correction that is applied [1]: none if the least eigenvalue of the moments is
/// below `surface`, `part` of it above `inside`, interpolated between. The density due to the
/// correction of the divergence relaxes in the time `memory` c0/g.
///
/// The plain sum is nearly the time derivative of a function of the positions, the density of the
/// packing. The sum of the correction is not: fluid that returns to its positions keeps a
/// remainder, always of one sign, and would become denser without a change of its density variable.
/// A wave of H/d = 0.2 that runs 12 of its lengths lowered the level by 2.4 % of the depth, in MPS
/// by 15 %, and went on; with these it falls by 0.4 and 1.0 % and stays. A long memory keeps the
/// correction of waves; without gravity nothing relaxes. Measured, ours.
struct CorrectionRange {
    real part;
    real surface;
    real inside;
    real memory;
};
/// In SPH a tenth of the error stays, and the plain form at a free surface: with the whole
/// correction, and with one up to the surface, water at rest convects, fed by its potential energy;
/// rms speed after 10 s in a tank of 1 m 9e-4, 1.2e-3 and with these 2e-4 sqrt(gH). Measured, ours;
/// the reason is not known.
inline constexpr CorrectionRange sph_correction{0.9, 0.8, 0.95, 1};
/// The weight of MPS, steep at its centre, keeps particles apart with the whole correction, too:
/// 1.6e-4 sqrt(gH). Its surface needs it: with the limits of SPH an elongated drop is 1.4 % too
/// long, with these 0.2 %.
inline constexpr CorrectionRange mps_correction{1, 0.5, 0.8, 0.3};

/// B - 1 = share (M^-1 - 1) from the moments M, the share as `range` has it.
Mat3 correction(const Mat3& M, const CorrectionRange& range);

/// Sets the corrections of the fluid rows from the moments of the last rates: they serve the next
/// step, its forces and its rates alike.
void update_corrections(const FluidParameters& fluid, Store& store);

/// Adds to the rates of density those of the correction, of which the sums are known, and lets what
/// the correction has made of the density relax.
void add_corrections(const FluidParameters& fluid, Store& store);

/// The pressure gradient, as the user chooses it.
struct GradientSettings {
    bool corrected = false;

    static void keys(auto& keys, auto& chosen)
    {
        keys.choice("gradient", chosen.corrected, {"plain", "corrected"},
                    "Pressure gradient of SPH. \"plain\": the symmetric form; \"corrected\": with "
                    "reverse kernel gradient correction, which is more accurate for waves and "
                    "accelerating bodies. MPS always uses the corrected gradient.");
    }
};

/// In the place of the plain pressure force; `GradientSettings` decide whether it holds its term.
struct GradientSlot {
    using Terms = std::variant<Off, CorrectedGradient>;
};

namespace slot {
inline constexpr GradientSlot gradient{};
}

} // namespace hyoryu
