// SPDX-License-Identifier: MIT
// Viscosity in the pair form of Monaghan & Gingold, artificial and laminar alike.
#pragma once

#include "hyoryu/fluid/parameters.hpp"
#include "hyoryu/fluid/slot.hpp"
#include "hyoryu/fluid/stage.hpp"

#include <fmt/format.h>

namespace hyoryu {

/// F_i = sum_j V_i V_j rho0 (kappa - beta min(v.r, 0)) v.r / (r^2 + 0.01 h^2) F(r) r,
/// v = v_i - v_j, kappa = alpha h c0 + 2 (d + 2) nu [m2/s]: acts along the line of centres, so it
/// conserves angular momentum, and it is consistent at a free surface, where the Morris form loses
/// half the dissipation (Colagrossi, Antuono, Souto-Iglesias & Le Touze 2011). The part of beta
/// acts between particles that approach: it takes the energy of impacts and leaves smooth flow
/// alone. Source: Monaghan & Gingold (1983); equivalence nu = alpha h c0 / (2 (d + 2)): Monaghan
/// (2005), sec. 8; beta = 3 is the limiter of Zhang, Hu & Adams (2017), J. Comput. Phys. 335.
struct Viscosity {
    static constexpr std::string_view name = "viscosity";
    using Stage = stage::Rates;
    using Reads = Fields<Velocity, Volume>;
    using Writes = Fields<ViscousForce>;
    real rho0 = 1000; // [kg/m3]
    real kappa = 0;   // [m2/s]
    real h = 1;       // [m]
    real beta = 0;    // [1]

    Viscosity at_wall() const { return *this; }

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        const N approach = dot(i[field::velocity] - j[field::velocity], ij.r);
        const N closing = positive(N(-approach));
        const N mu = (rho0 * kappa + rho0 * beta * closing) * approach /
                     (ij.distance_squared + 0.01 * sq(h));
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

/// The artificial viscosity, as the user chooses it.
struct ArtificialViscosity {
    static constexpr std::string_view name = "artificial_viscosity"; // in the plan
    using Makes = TermList<Viscosity>;
    static constexpr std::string_view model = "artificial";
    static constexpr std::string_view says = "damps with the coefficient `alpha`";
    double alpha = 0.02; // [1]
    double beta = 0;     // [1]

    static void keys(auto& keys, auto& chosen)
    {
        keys.not_negative(
            "alpha", chosen.alpha, "",
            "Coefficient of the artificial viscosity; 0.01 to 0.1 for dam breaks and bores.");
        keys.not_negative(
            "beta", chosen.beta, "",
            "Coefficient of the quadratic part, which acts between approaching particles; 3 "
            "dissipates the energy of impacts and leaves smooth flow unaffected.");
    }
    std::string why() const
    {
        return fmt::format("`fluid.viscosity.model` is \"artificial\", alpha = {}{}", alpha,
                           beta > 0 ? fmt::format(", beta = {}", beta) : "");
    }
    void fill(auto& slot, const FluidParameters& f) const
    {
        if (const real kappa = artificial_kappa(alpha, f.h, f.eos.c0); kappa > 0 || beta > 0) {
            slot = Viscosity{f.eos.rho0, kappa, f.h, beta};
        }
    }
};

/// The laminar viscosity, as the user chooses it.
struct LaminarViscosity {
    static constexpr std::string_view name = "laminar_viscosity"; // in the plan
    using Makes = TermList<Viscosity, MorrisViscosity>;
    static constexpr std::string_view model = "laminar";
    static constexpr std::string_view says = "uses a physical viscosity (`kinematic`)";
    double kinematic = 1e-6; // [m2/s]
    bool morris = false;     // the form of `MorrisViscosity`

    static void kinematic_key(auto& keys, auto& kinematic)
    {
        keys.not_negative(
            "kinematic", kinematic, "m2/s",
            "Kinematic viscosity of the laminar model; 1e-6 m2/s for water at 20 degrees Celsius.");
    }
    static void keys(auto& keys, auto& chosen)
    {
        kinematic_key(keys, chosen.kinematic);
        keys.choice("form", chosen.morris, {"central", "morris"},
                    "Form of the laminar model. \"central\" acts along the line between two "
                    "particles and is correct at free surfaces; \"morris\" is exact in shear flow "
                    "along rows of particles and is intended for flows between walls.");
    }
    std::string why() const
    {
        return fmt::format("`fluid.viscosity.model` is \"laminar\", kinematic = {} m2/s",
                           kinematic);
    }
    void fill(auto& slot, const FluidParameters& f) const
    {
        const real kappa = laminar_kappa(kinematic, f.dimensions);
        if (kappa > 0 && morris) {
            slot = MorrisViscosity{f.eos.rho0 * kinematic};
        } else if (kappa > 0) {
            slot = Viscosity{f.eos.rho0, kappa, f.h};
        }
    }
};

} // namespace hyoryu
