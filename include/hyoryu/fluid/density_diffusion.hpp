// SPDX-License-Identifier: MIT
// Density diffusion: smooths the acoustic noise of the weakly compressible pressure.
#pragma once

#include "hyoryu/fluid/moment_sum.hpp"
#include "hyoryu/fluid/parameters.hpp"
#include "hyoryu/fluid/slot.hpp"
#include "hyoryu/fluid/stage.hpp"

#include <string>

namespace hyoryu {

/// D_i = -2 delta h c0 sum_j V_j [(rho_j - rho_i) - rhoH_ji] F(r), rhoH_ji = (rho0/c0^2) g . (r_j -
/// r_i): only the part of the density difference that is not hydrostatic diffuses. Without
/// `hydrostatic` (g = 0 here) it is the term of Molteni & Colagrossi (2009), which sinks still
/// water. Source: Fourtakas, Dominguez, Vacondio & Rogers (2019), linear equation of state.
struct DensityDiffusion {
    static constexpr std::string_view name = "density_diffusion";
    using Stage = stage::Forces;
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

/// Sums for the gradient of the density over the fluid about a particle, G_i = sum_j V_j (p_j -
/// p_i) F r and M_i = -sum_j V_j F r r^T: the gradient of the pressure is M_i^-1 G_i.
struct DensityGradient {
    static constexpr std::string_view name = "density_gradient";
    using Reads = Fields<Volume, Pressure>;
    using Writes = Fields<PressureGradient, Moments, MixedMoments>;

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        const Vec<N> step = (j[field::volume] * ij.f) * ij.r;
        sum[field::pressure_gradient] += (j[field::pressure] - i[field::pressure]) * step;
        add_moments(step, ij.r, sum);
    }
};

/// D_i = -2 delta h c0 sum_j V_j [(rho_j - rho_i) - (g_i + g_j)/2 . (r_j - r_i)] F(r), g the
/// renormalised gradient of the density, kept as c0^2 g in the column of `PressureGradient`: a
/// linear density field does not diffuse, whatever its cause. Source: Antuono, Colagrossi, Marrone
/// & Molteni (2010), eq. 7.
struct RenormalisedDiffusion {
    static constexpr std::string_view name = "renormalised_diffusion";
    using Reads = Fields<Volume, Pressure, PressureGradient>;
    using Writes = Fields<DiffusionRate>;
    using Columns = Union<Writes, DensityGradient::Writes>;
    struct Sum {
        static void call(const auto& terms, const auto& f)
        {
            if (const auto* own = held<RenormalisedDiffusion>(terms.effects)) {
                f(*own);
            }
        }
    };
    using Passes = PassList<PassOf<DensityGradient>, Sum>;
    real strength = 0; // 2 delta h c0 [m2/s]
    EquationOfState eos;

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        const N linear = 0.5 * dot(i[field::pressure_gradient] + j[field::pressure_gradient], ij.r);
        const N difference = (j[field::pressure] - i[field::pressure] + linear) * (1 / sq(eos.c0));
        sum[field::diffusion_rate] += -strength * j[field::volume] * difference * ij.f;
    }
};

/// The input parameter of all density diffusion models.
struct DiffusionSettings {
    static constexpr std::string_view name = "density_diffusion"; // in the plan
    double delta = 0.1;                                           // [1]

    static void keys(auto& keys, auto& chosen)
    {
        keys.not_negative("delta", chosen.delta, "", "Coefficient of the density diffusion.");
    }
    std::string why() const
    {
        return "`fluid.density_diffusion.model` is not \"none\": reduces acoustic noise in the "
               "pressure";
    }
    void fill_with(auto& slot, const FluidParameters& f, const Vec3& hydrostatic) const
    {
        if (delta > 0) {
            slot = DensityDiffusion{2 * delta * f.h * f.eos.c0, f.eos, hydrostatic};
        }
    }
};
struct FourtakasDiffusion : DiffusionSettings {
    using Makes = TermList<DensityDiffusion>;
    static constexpr std::string_view model = "fourtakas";
    static constexpr std::string_view says =
        "corrects for the hydrostatic density gradient and suits deep still water";
    void fill(auto& slot, const FluidParameters& f) const
    {
        fill_with(slot, f, f.eos.rho0 / sq(f.eos.c0) * f.gravity);
    }
};
struct MolteniDiffusion : DiffusionSettings {
    using Makes = TermList<DensityDiffusion>;
    static constexpr std::string_view model = "molteni";
    static constexpr std::string_view says = "has no such correction";
    void fill(auto& slot, const FluidParameters& f) const { fill_with(slot, f, Vec3::Zero()); }
};
struct AntuonoDiffusion : DiffusionSettings {
    using Makes = TermList<RenormalisedDiffusion>;
    static constexpr std::string_view model = "antuono";
    static constexpr std::string_view says =
        "corrects for any density gradient at the cost of two additional particle sums";
    std::string why() const
    {
        return "`fluid.density_diffusion.model` is \"antuono\": renormalised gradients";
    }
    void fill(auto& slot, const FluidParameters& f) const
    {
        if (delta > 0) {
            slot = RenormalisedDiffusion{2 * delta * f.h * f.eos.c0, f.eos};
        }
    }
};

/// With the pressure force; diffuses density.
struct DiffusionSlot {
    using Models = std::variant<FourtakasDiffusion, MolteniDiffusion, AntuonoDiffusion, Off>;
    using Terms = TermsOf<Models>;
    static constexpr SlotTable table{
        "density_diffusion", "Density diffusion, which removes pressure noise.",
        ", \"none\" disables density diffusion.", "`fluid.density_diffusion.model` is \"none\""};
};

namespace slot {
inline constexpr DiffusionSlot diffusion{};
}

} // namespace hyoryu
