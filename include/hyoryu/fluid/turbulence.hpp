// SPDX-License-Identifier: MIT
// Sub-particle-scale turbulence: an eddy viscosity from the rate of strain.
#pragma once

#include "hyoryu/fluid/slot.hpp"
#include "hyoryu/fluid/stage.hpp"
#include "hyoryu/fluid/viscosity.hpp"

namespace hyoryu {

/// Sums for twice the rate of strain, E_i = sum_j V_j [(v_j - v_i) r^T + r (v_j - v_i)^T] F. Near a
/// free surface, where half of the neighbours are missing, they are too small by that half.
struct StrainRate {
    static constexpr std::string_view name = "strain_rate";
    using Reads = Fields<Velocity, Volume>;
    using Writes = Fields<Strain, MixedStrain>;

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        const Vec<N> dv = (j[field::volume] * ij.f) * (j[field::velocity] - i[field::velocity]);
        const Vec<N>& r = ij.r;
        sum[field::strain] += Vec<N>{2 * dv.x * r.x, 2 * dv.y * r.y, 2 * dv.z * r.z};
        sum[field::mixed_strain] +=
            Vec<N>{dv.y * r.z + dv.z * r.y, dv.x * r.z + dv.z * r.x, dv.x * r.y + dv.y * r.x};
    }
};

/// nu_t = (Cs dp)^2 |S|, |S| = sqrt(2 S:S), from the sums E = 2 S. Source: Smagorinsky (1963).
inline real eddy_viscosity(const Vec3& strain, const Vec3& mixed_strain, real length)
{
    return sq(length) * std::sqrt((strain.squaredNorm() + 2 * mixed_strain.squaredNorm()) / 2);
}

/// The pair viscosity with kappa = 2 (d + 2) [nu + (nu_t,i + nu_t,j)/2]; to a solid, which has no
/// nu_t of its own, that of the fluid particle. Source: Di Mascio, Antuono, Colagrossi & Marrone
/// (2017), with the arithmetic mean; Dalrymple & Rogers (2006) have the divergence of the stress in
/// its place, which turns rigid rotation at a free surface into a force.
struct EddyViscosity {
    static constexpr std::string_view name = "eddy_viscosity";
    using Stage = stage::Rates;
    using Reads = Fields<Velocity, Volume, TurbulentViscosity>;
    using Writes = Fields<ViscousForce>;
    using Columns = Union<Writes, StrainRate::Writes, Fields<TurbulentViscosity>>;
    using Passes = PassList<PassOf<StrainRate>>;
    real rho0 = 1000; // [kg/m3]
    real kappa = 0;   // 2 (d + 2) nu [m2/s]
    real h = 1;       // [m]
    real share = 0;   // d + 2; twice that to solids [1]
    real length = 0;  // Cs dp [m]

    EddyViscosity at_wall() const { return {rho0, kappa, h, 2 * share, length}; }

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        const N approach = dot(i[field::velocity] - j[field::velocity], ij.r);
        const N both =
            kappa + share * (i[field::turbulent_viscosity] + j[field::turbulent_viscosity]);
        const N mu = rho0 * both * approach / (ij.distance_squared + 0.01 * sq(h));
        sum[field::viscous_force] += (i[field::volume] * j[field::volume]) * mu * ij.f * ij.r;
    }
};

/// The eddy viscosity over a kinematic one, as the user chooses it.
struct SpsViscosity {
    static constexpr std::string_view name = "sps_turbulence"; // in the plan
    using Makes = TermList<Viscosity, EddyViscosity>;
    static constexpr std::string_view model = "sps";
    static constexpr std::string_view says = "adds an eddy viscosity to the physical viscosity";
    double kinematic = 1e-6;   // [m2/s]
    double smagorinsky = 0.12; // Cs [1]

    static void keys(auto& keys, auto& chosen)
    {
        LaminarViscosity::kinematic_key(keys, chosen.kinematic);
        keys.not_negative("smagorinsky", chosen.smagorinsky, "",
                          "Smagorinsky constant Cs of \"sps\": the length scale of the eddies is "
                          "Cs times the particle spacing.");
    }
    std::string why() const
    {
        return fmt::format(
            "`fluid.viscosity.model` is \"sps\", kinematic = {} m2/s, smagorinsky = {}", kinematic,
            smagorinsky);
    }
    void fill(auto& slot, const FluidParameters& f) const
    {
        const real kappa = laminar_kappa(kinematic, f.dimensions);
        if (smagorinsky > 0) {
            slot = EddyViscosity{f.eos.rho0, kappa, f.h, static_cast<real>(f.dimensions + 2),
                                 smagorinsky * f.spacing};
        } else if (kappa > 0) {
            slot = Viscosity{f.eos.rho0, kappa, f.h};
        }
    }
};

/// Viscosity of every kind, with continuity.
struct ViscositySlot {
    using Models = std::variant<ArtificialViscosity, LaminarViscosity, SpsViscosity, Off>;
    using Terms = TermsOf<Models>;
    static constexpr SlotTable table{"viscosity", "Viscosity of the fluid.",
                                     ", \"none\" is inviscid.",
                                     "`fluid.viscosity` selects another model or none"};
};

namespace slot {
inline constexpr ViscositySlot viscosity{};
}

} // namespace hyoryu
