// SPDX-License-Identifier: MIT
// Walls and bodies to which the fluid sticks.
#pragma once

#include "hyoryu/fluid/slot.hpp"
#include "hyoryu/fluid/stage.hpp"

namespace hyoryu {

/// Sums of W, W v and W r over the fluid before a solid particle, of which `mirrored_velocity`
/// makes the velocity that it shows to the viscosity.
/// Source: Adami, Hu & Adams (2012), eq. 23.
struct NoSlip {
    static constexpr std::string_view name = "no_slip";
    using Reads = Fields<Velocity>;
    using Writes = Fields<ShepardSum, VelocitySum, OffsetSum>;
    using Columns = Union<Writes, Fields<Depth, ViscousForce>>;
    static constexpr bool needs_solids = true;
    /// Viscous forces between the fluid and the solids to which it sticks.
    struct Friction {
        static void call(const auto& terms, const auto& f)
        {
            for_each_effect(terms.effects, [&](const auto& effect) {
                if constexpr (requires { effect.at_wall(); }) {
                    f(effect.at_wall());
                }
            });
        }
    };
    struct Mirror; // sums this term
    using Passes = PassList<Mirror, Friction>;

    template <class N>
    void operator()(const Pair<N>& ij, const auto&, const auto& j, auto& sum) const
    {
        sum[field::shepard_sum] += ij.w;
        sum[field::velocity_sum] += ij.w * j[field::velocity];
        sum[field::offset_sum] += ij.w * ij.r;
    }
};

struct NoSlip::Mirror : PassOf<NoSlip> {};

/// v_w = u - (d_w/d_f) (<v> - u): the mean velocity <v> of the fluid before a solid particle of
/// velocity u, continued in a straight line through u on the surface. d_w is the depth of the
/// particle behind the surface, d_f the distance of the middle of that fluid before it, the mean
/// offset less d_w, at least half a spacing. With d_w = d_f it is eq. 23 of Adami, Hu & Adams
/// (2012); the ratio, after Morris, Fox & Zhu (1997), makes it exact in a uniform shear.
inline Vec3 mirrored_velocity(const Vec3& u, const Vec3& mean_velocity, const Vec3& mean_offset,
                              real depth, real spacing)
{
    const real before = std::max(mean_offset.norm() - depth, spacing / 2);
    return u - (depth / before) * (mean_velocity - u);
}

/// How the fluid meets walls and bodies, as the user chooses it.
struct SlipSettings {
    bool sticks = false;

    static void keys(auto& keys, auto& chosen)
    {
        keys.choice("walls", chosen.sticks, {"free_slip", "no_slip"},
                    "Velocity boundary condition at walls and bodies. \"free_slip\": no friction; "
                    "\"no_slip\": the fluid adheres to them through its viscosity.");
    }
};

/// Viscosity at solids; `SlipSettings` and a viscosity decide whether it holds its term.
struct SlipSlot {
    using Terms = std::variant<Off, NoSlip>;
};

namespace slot {
inline constexpr SlipSlot slip{};
}

} // namespace hyoryu
