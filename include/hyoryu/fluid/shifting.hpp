// SPDX-License-Identifier: MIT
// Particle shifting: evens out the places of the particles of confined flows.
#pragma once

#include "hyoryu/core/kernel.hpp"
#include "hyoryu/fluid/parameters.hpp"
#include "hyoryu/fluid/slot.hpp"
#include "hyoryu/fluid/stage.hpp"

#include <string>

namespace hyoryu {

/// sum V grad W over the fluid near a particle and half of the same sum over the solids: of a pair
/// of fluid particles both are shifted.
struct ConcentrationGradient {
    using type = Vec3;
    static constexpr FieldInfo info{"ConcentrationGradient", "1/m", Holders::fluid};
};
/// Change of density due to shifts that the density has not yet taken over.
struct OwedDensity {
    using type = real;
    static constexpr FieldInfo info{"OwedDensity", "kg/m3", Holders::fluid, true};
};
namespace field {
inline constexpr ConcentrationGradient concentration_gradient{};
inline constexpr OwedDensity owed_density{};
} // namespace field

/// S_i = sum_j V_j [1 + 0.2 (W/W(dp))^4] F r, which points to where particles are dense; each is
/// moved by -C h |v|max dt S_i, at most 0.05 dp. At a free surface the sum points inwards and the
/// fluid would swell. Source: Sun, Colagrossi, Marrone & Zhang (2017), eq. 17, without a change of
/// velocity.
struct Shifting {
    static constexpr std::string_view name = "shifting";
    using Stage = stage::Crowding;
    using Reads = Fields<Volume>;
    using Writes = Fields<ShiftGradient>;
    real coefficient = 8; // C [1]
    real w_scale = 0;     // 1/W(dp) [m^d]

    template <class N>
    void operator()(const Pair<N>& ij, const auto&, const auto& j, auto& sum) const
    {
        const N w = sq(N(ij.w * w_scale));
        sum[field::shift_gradient] += (j[field::volume] * (1 + 0.2 * (w * w))) * ij.f * ij.r;
    }
};

/// The same, and the density follows, so that the mean density of a closed flow is kept.
///
/// The flow makes the particles less even, which continuity counts as a compression. Shifts d make
/// them even again: the concentration sum V W changes, summed over all particles, by the sum of
/// 2 d.G_f + d.G_s, with the sums G of V grad W over fluid and solids, of which only the fluid is
/// shifted. The density of each particle takes that change over, relative to its own density. In
/// this form, the change by the motion of the neighbours less the mass that they would carry along,
/// it is that of P.-N. Sun, A. Colagrossi, S. Marrone, M. Antuono & A.-M. Zhang (2019), Comput.
/// Methods Appl. Mech. Engrg. 348, 912, for a constant density. Ours: it is taken over in a time of
/// 100 h/c0. At once it would be a source of sound, whose velocities would make the shifts larger.
struct ConservativeShifting {
    static constexpr std::string_view name = Shifting::name;
    using Stage = stage::Crowding;
    using Reads = Shifting::Reads;
    using Writes = Union<Shifting::Writes, Fields<ConcentrationGradient>>;
    using Columns = Union<Writes, Fields<OwedDensity>>;
    static constexpr real release = 100; // [h/c0]
    Shifting shifting;

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        shifting(ij, i, j, sum);
        sum[field::concentration_gradient] += (j[field::volume] * ij.f) * ij.r;
    }
};

/// Shifting, as the user chooses it.
struct SunShifting {
    static constexpr std::string_view name = Shifting::name;
    using Makes = TermList<Shifting, ConservativeShifting>;
    static constexpr std::string_view model = "sun";
    static constexpr std::string_view says =
        "moves particles away from regions of high particle concentration, for flows without a "
        "free surface, at which the fluid would expand";
    static constexpr bool for_sph_alone = true; // its kernel is that of SPH
    double coefficient = 8;                     // [1]
    bool conservative = false;                  // the continuity of `ConservativeShifting`

    static void keys(auto& keys, auto& chosen)
    {
        keys.not_negative("coefficient", chosen.coefficient, "",
                          "Coefficient C of the shift, which is -C h |v|max dt times the gradient "
                          "of the particle concentration.");
        keys.choice("continuity", chosen.conservative, {"plain", "conservative"},
                    "Density of shifted particles. \"plain\": unchanged, so that the mean density "
                    "of a closed flow drifts; \"conservative\": changed by the change of the "
                    "particle concentration, which keeps the mean density.");
    }
    std::string why() const
    {
        return std::string("`fluid.shifting.model` is \"sun\": evens out the particle positions") +
               (conservative ? "; the mean density is kept" : "");
    }
    void fill(auto& slot, const FluidParameters& f) const
    {
        if (coefficient > 0) {
            const Kernel kernel = make_kernel(f.h, f.spacing, f.dimensions);
            const Shifting shifting{coefficient, 1 / kernel(Vec<real>{f.spacing, 0, 0}).w};
            if (conservative) {
                slot = ConservativeShifting{shifting};
            } else {
                slot = shifting;
            }
        }
    }
};

/// After the rates.
struct ShiftingSlot {
    using Models = std::variant<Off, SunShifting>;
    using Terms = TermsOf<Models>;
    static constexpr SlotTable table{
        "shifting", "Particle shifting, which makes the particle distribution more uniform.",
        "; \"none\" disables shifting.", "`fluid.shifting.model` is \"none\""};
};

namespace slot {
inline constexpr ShiftingSlot shifting{};
}

} // namespace hyoryu
