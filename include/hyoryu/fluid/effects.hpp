// SPDX-License-Identifier: MIT
// The slots: which families of effects exist and which alternatives each has. A new effect is one
// file with its term and one line here.
#pragma once

#include "hyoryu/core/built_effects.hpp"
#include "hyoryu/fluid/cavitation.hpp"
#include "hyoryu/fluid/collision.hpp"
#include "hyoryu/fluid/continuity.hpp"
#include "hyoryu/fluid/density_diffusion.hpp"
#include "hyoryu/fluid/no_slip.hpp"
#include "hyoryu/fluid/parting.hpp"
#include "hyoryu/fluid/pressure.hpp"
#include "hyoryu/fluid/shifting.hpp"
#include "hyoryu/fluid/turbulence.hpp"
#include "hyoryu/fluid/viscosity.hpp"
#include "hyoryu/fluid/wall.hpp"

#include <variant>

namespace hyoryu {

/// One slot for each family of exclusive effects; `Off` first. What a slot holds decides the
/// columns, the terms of the fused sweeps and what the plan says.
struct FluidEffects {
    std::variant<Off, DensityDiffusion, RenormalisedDiffusion> diffusion;   // of density
    std::variant<Off, Viscosity, MorrisViscosity, EddyViscosity> viscosity; // with continuity
    std::variant<Off, Shifting> shifting;                                   // after it
    std::variant<Off, NoSlip> slip;                                         // viscosity at solids
    std::variant<Off, ParticleCollision> collision; // with the pressure force
    std::variant<Off, Cavitation> cavitation;       // where density moves on
};

/// The effect if the slot holds it and it is part of this build; null otherwise.
template <class Effect, class... Effects>
constexpr const Effect* held(const std::variant<Effects...>& slot)
{
    if constexpr (is_built<Effect>) {
        return std::get_if<Effect>(&slot);
    } else {
        return nullptr;
    }
}

} // namespace hyoryu
