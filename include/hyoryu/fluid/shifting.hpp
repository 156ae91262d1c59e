// SPDX-License-Identifier: MIT
// Particle shifting: evens out the places of the particles of confined flows.
#pragma once

#include "hyoryu/core/kernel.hpp"
#include "hyoryu/fluid/parameters.hpp"
#include "hyoryu/fluid/slot.hpp"
#include "hyoryu/fluid/stage.hpp"

#include <string>

namespace hyoryu {

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

/// Shifting, as the user chooses it.
struct SunShifting {
    static constexpr std::string_view name = Shifting::name;
    using Makes = TermList<Shifting>;
    static constexpr std::string_view model = "sun";
    static constexpr std::string_view says =
        "moves particles away from regions of high particle concentration, for flows without a "
        "free surface, at which the fluid would expand";
    static constexpr bool for_sph_alone = true; // its kernel is that of SPH
    double coefficient = 8;                     // [1]

    static void keys(auto& keys, auto& chosen)
    {
        keys.not_negative("coefficient", chosen.coefficient, "",
                          "Coefficient C of the shift, which is -C h |v|max dt times the gradient "
                          "of the particle concentration.");
    }
    std::string why() const
    {
        return "`fluid.shifting.model` is \"sun\": evens out the particle positions";
    }
    void fill(auto& slot, const FluidParameters& f) const
    {
        if (coefficient > 0) {
            const Kernel kernel = make_kernel(f.h, f.spacing, f.dimensions);
            slot = Shifting{coefficient, 1 / kernel(Vec<real>{f.spacing, 0, 0}).w};
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
