// SPDX-License-Identifier: MIT
// The slots: which families of effects exist and which alternatives each has. A new effect of a
// family is one file, and its term and model in the lists of their slot here. A new family needs a
// slot in `FluidEffects`, `slots_of` and `FluidChoices`, and its table in `each_slot`.
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
#include "hyoryu/fluid/stage.hpp"
#include "hyoryu/fluid/turbulence.hpp"
#include "hyoryu/fluid/viscosity.hpp"
#include "hyoryu/fluid/wall.hpp"

#include <tuple>
#include <utility>
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

/// The slots side by side: whatever is done for every effect goes over them.
inline auto slots_of(auto& effects)
{
    auto& [diffusion, viscosity, shifting, slip, collision, cavitation] = effects;
    return std::tie(diffusion, viscosity, shifting, slip, collision, cavitation);
}

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

/// f(effect) for the effect that a slot holds, `Off` and effects that are not built left out.
// Unlike std::visit it has no way to throw, whose code the instruction sets would share.
template <class... Effects>
void with_held(const std::variant<Effects...>& slot, const auto& f)
{
    const auto try_one = [&]<class Effect>(const Effect* effect) {
        if constexpr (is_built<Effect> && !std::is_same_v<Effect, Off>) {
            if (effect != nullptr) {
                f(*effect);
            }
        }
    };
    (try_one(std::get_if<Effects>(&slot)), ...);
}

/// f(effect) for every effect that is held.
void for_each_effect(const FluidEffects& effects, const auto& f)
{
    std::apply([&](const auto&... slot) { (with_held(slot, f), ...); }, slots_of(effects));
}

/// Whether the pair term of an effect is summed in a stage.
template <class Effect, class Stage>
concept InStage = is_built<Effect> && requires
{
    requires std::is_same_v<typename Effect::Stage, Stage>;
};

/// f(terms...) with the effects of a stage that are held, slot by slot.
template <class Stage, std::size_t k = 0, class... Slots>
void with_terms_of(const std::tuple<Slots...>& slots, const auto& f, const auto&... found)
{
    if constexpr (k == sizeof...(Slots)) {
        f(found...);
    } else {
        bool held_one = false;
        const auto try_one = [&]<class Effect>(const Effect* effect) {
            if constexpr (InStage<Effect, Stage>) {
                if (effect != nullptr) {
                    held_one = true;
                    with_terms_of<Stage, k + 1>(slots, f, found..., *effect);
                }
            }
        };
        [&]<class... Effects>(const std::variant<Effects...>& slot) {
            (try_one(std::get_if<Effects>(&slot)), ...);
        }(std::get<k>(slots));
        if (!held_one) {
            with_terms_of<Stage, k + 1>(slots, f, found...);
        }
    }
}

namespace detail {
template <class Effect>
struct PassesOf {
    using type = PassList<>;
};
template <class Effect>
requires(is_built<Effect>) && requires
{
    typename Effect::Passes;
}
struct PassesOf<Effect> {
    using type = typename Effect::Passes;
};
template <class Slots>
struct PassesOfSlots;
template <class... Effects>
struct PassesOfSlots<std::variant<Effects...>> : JoinedPasses<typename PassesOf<Effects>::type...> {
};
template <class Tuple>
struct PassesOfAll;
template <class... Slots>
struct PassesOfAll<std::tuple<Slots&...>> : JoinedPasses<typename PassesOfSlots<Slots>::type...> {
};

template <class Effect, class Stage>
struct WritesOf {
    using type = Fields<>;
};
template <class Effect, class Stage>
requires(InStage<Effect, Stage>) struct WritesOf<Effect, Stage> {
    using type = typename Effect::Writes;
};
template <class Slot, class Stage>
struct WritesOfSlot;
template <class... Effects, class Stage>
struct WritesOfSlot<std::variant<Effects...>, Stage> {
    using type = Union<typename WritesOf<Effects, Stage>::type...>;
};
template <class Tuple, class Stage>
struct WritesOfAll;
template <class... Slots, class Stage>
struct WritesOfAll<std::tuple<Slots&...>, Stage> {
    using type = Union<typename WritesOfSlot<Slots, Stage>::type...>;
};
using AllSlots = decltype(slots_of(std::declval<FluidEffects&>()));
} // namespace detail

/// The passes of all effects that are built.
using EffectPasses = typename detail::PassesOfAll<detail::AllSlots>::type;

/// What the effects of a stage write, whichever are held.
template <class Stage>
using StageWrites = typename detail::WritesOfAll<detail::AllSlots, Stage>::type;

/// What the user chooses for the slots: the models of each, of which the first is the default. A
/// model has a `name` in the plan, the `model` that stands in the case file and what it `says` of
/// itself there, its `keys`, the reason `why` it runs, and the term that it puts into the slot.
struct FluidChoices {
    std::variant<ArtificialViscosity, LaminarViscosity, SpsViscosity, Off> viscosity;
    std::variant<FourtakasDiffusion, MolteniDiffusion, AntuonoDiffusion, Off> diffusion;
    std::variant<Off, SunShifting> shifting;
    std::variant<Off, DynamicCollision> collision;
    std::variant<Off, VoidCavitation> cavitation;
};

/// The table of a slot in the case file.
struct SlotTable {
    std::string_view key; // of [fluid]
    std::string_view meaning;
    std::string_view none; // what is said of the model "none", after the others
    std::string_view off;  // why no model runs
};

/// Calls `visit(table, choice, slot)` for each slot that has a table, in the order of the manual.
template <class Visit>
void each_slot(auto& choices, Visit&& visit)
{
    visit(SlotTable{"viscosity", "Viscosity of the fluid.", ", \"none\" is inviscid.",
                    "`fluid.viscosity` selects another model or none"},
          choices.viscosity, &FluidEffects::viscosity);
    visit(SlotTable{"density_diffusion",
                    "Diffusion of density, which removes noise of the pressure.",
                    ", \"none\" switches it off.", "`fluid.density_diffusion.model` is \"none\""},
          choices.diffusion, &FluidEffects::diffusion);
    visit(SlotTable{"shifting", "Particle shifting, which evens out the particle positions.",
                    "; \"none\" switches it off.", "`fluid.shifting.model` is \"none\""},
          choices.shifting, &FluidEffects::shifting);
    visit(SlotTable{"collision", "Collisions of fluid particles, for splashes.",
                    "; \"none\" switches it off.", "`fluid.collision.model` is \"none\""},
          choices.collision, &FluidEffects::collision);
    visit(SlotTable{"cavitation", "Voids that open under tension.",
                    "; \"none\": the fluid sustains tension.",
                    "`fluid.cavitation.model` is \"none\": the fluid sustains tension"},
          choices.cavitation, &FluidEffects::cavitation);
}

/// The effects of a fluid that the user has chosen.
inline FluidEffects chosen_effects(const FluidChoices& choices, const SlipSettings& walls,
                                   const FluidParameters& fluid)
{
    FluidEffects effects;
    each_slot(choices, [&](const SlotTable& /*table*/, const auto& choice, auto slot) {
        const auto fill = [&]<class Model>(const Model& model) {
            if constexpr (!std::same_as<Model, Off>) {
                model.fill(effects.*slot, fluid);
            }
        };
        std::visit(fill, choice);
    });
    if (walls.sticks && !std::holds_alternative<Off>(effects.viscosity)) {
        effects.slip = NoSlip{};
    }
    return effects;
}

} // namespace hyoryu
