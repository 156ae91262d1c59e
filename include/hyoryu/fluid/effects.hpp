// SPDX-License-Identifier: MIT
// The effects that a fluid has, and what follows from the list of slots: which terms a stage sums,
// which passes exist, which columns are written.
#pragma once

#include "hyoryu/core/built_effects.hpp"
#include "hyoryu/fluid/slots.hpp"
#include "hyoryu/fluid/stage.hpp"

#include <variant>

namespace hyoryu {

/// One term for each family of exclusive effects, or `Off`. What a slot holds decides the columns,
/// the terms of the fused sweeps and what the plan says.
using FluidEffects = HeldTerms<AllSlots>;

/// The user's choice of a model for each slot.
using FluidChoices = ChosenModels<ModelSlots<AllSlots>>;

/// Whether a type is among those of a variant.
template <class T, class... U>
inline constexpr bool contains<T, std::variant<U...>> = (std::is_same_v<T, U> || ...);

namespace detail {
template <class Effect, class List>
struct SlotOf;
template <class Effect, class First, class... Rest>
struct SlotOf<Effect, SlotList<First, Rest...>>
    : std::conditional_t<contains<Effect, typename First::Terms>, std::type_identity<First>,
                         SlotOf<Effect, SlotList<Rest...>>> {
};
} // namespace detail

/// The effect if its slot holds it and it is part of this build; null otherwise.
template <class Effect>
constexpr const Effect* held(const FluidEffects& effects)
{
    if constexpr (is_built<Effect>) {
        return std::get_if<Effect>(&effects[typename detail::SlotOf<Effect, AllSlots>::type{}]);
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
    for_each(AllSlots{}, [&](auto slot) { with_held(effects[slot], f); });
}

/// Whether the pair term of an effect is summed in a stage.
template <class Effect, class Stage>
concept InStage = is_built<Effect> && requires
{
    requires std::is_same_v<typename Effect::Stage, Stage>;
};

namespace detail {
template <class Stage>
void with_terms_of(SlotList<>, const FluidEffects&, const auto& f, const auto&... found)
{
    f(found...);
}
template <class Stage, class First, class... Rest>
void with_terms_of(SlotList<First, Rest...>, const FluidEffects& effects, const auto& f,
                   const auto&... found)
{
    constexpr SlotList<Rest...> rest;
    bool held_one = false;
    const auto try_one = [&]<class Effect>(const Effect* effect) {
        if constexpr (InStage<Effect, Stage>) {
            if (effect != nullptr) {
                held_one = true;
                with_terms_of<Stage>(rest, effects, f, found..., *effect);
            }
        }
    };
    [&]<class... Effects>(const std::variant<Effects...>& slot) {
        (try_one(std::get_if<Effects>(&slot)), ...);
    }(effects[First{}]);
    if (!held_one) {
        with_terms_of<Stage>(rest, effects, f, found...);
    }
}
} // namespace detail

/// f(terms...) with the effects of a stage that are held, slot by slot.
template <class Stage>
void with_terms_of(const FluidEffects& effects, const auto& f)
{
    detail::with_terms_of<Stage>(AllSlots{}, effects, f);
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
template <class Terms>
struct PassesOfSlot;
template <class... Effects>
struct PassesOfSlot<std::variant<Effects...>> : JoinedPasses<typename PassesOf<Effects>::type...> {
};
template <class List>
struct PassesOfAll;
template <class... Slots>
struct PassesOfAll<SlotList<Slots...>>
    : JoinedPasses<typename PassesOfSlot<typename Slots::Terms>::type...> {
};

template <class Effect, class Stage>
struct WritesOf {
    using type = Fields<>;
};
template <class Effect, class Stage>
requires(InStage<Effect, Stage>) struct WritesOf<Effect, Stage> {
    using type = typename Effect::Writes;
};
template <class Terms, class Stage>
struct WritesOfSlot;
template <class... Effects, class Stage>
struct WritesOfSlot<std::variant<Effects...>, Stage> {
    using type = Union<typename WritesOf<Effects, Stage>::type...>;
};
template <class List, class Stage>
struct WritesOfAll;
template <class... Slots, class Stage>
struct WritesOfAll<SlotList<Slots...>, Stage> {
    using type = Union<typename WritesOfSlot<typename Slots::Terms, Stage>::type...>;
};
} // namespace detail

/// The passes of all effects that are built.
using EffectPasses = typename detail::PassesOfAll<AllSlots>::type;

/// The union of the fields that the effects of a stage may write.
template <class Stage>
using StageWrites = typename detail::WritesOfAll<AllSlots, Stage>::type;

/// The effects of a fluid that the user has chosen.
inline FluidEffects chosen_effects(const FluidChoices& choices, const GradientSettings& gradient,
                                   const WallContinuitySettings& continuity,
                                   const SlipSettings& walls, const FluidParameters& fluid)
{
    FluidEffects effects;
    for_each(ModelSlots<AllSlots>{}, [&](auto slot) {
        const auto fill = [&]<class Model>(const Model& model) {
            if constexpr (!std::same_as<Model, Off>) {
                model.fill(effects[slot], fluid);
            }
        };
        std::visit(fill, choices[slot]);
    });
    if (gradient.corrected || fluid.formulation == FormulationKind::mps) {
        effects[slot::gradient] = CorrectedGradient{};
    }
    if (continuity.paired) {
        effects[slot::wall_continuity] = PairedWalls{};
    }
    if (walls.sticks && !std::holds_alternative<Off>(effects[slot::viscosity])) {
        effects[slot::slip] = NoSlip{};
    }
    return effects;
}

} // namespace hyoryu
