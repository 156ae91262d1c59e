// SPDX-License-Identifier: MIT
// A slot: a family of effects that exclude each other, described completely by one type.
// `slots.hpp` lists the slots; allocation, the pair loops, the plan, the cost, the case file and
// its description go over that list.
//
// The type of a slot has
//     using Models = std::variant<...>;       // what the user may choose; the first is the default
//     static constexpr SlotTable table{...};  // where the choice stands in the case file
//     using Terms = TermsOf<Models>;          // what may be held: `Off` or a term of a model
// or, if other keys decide what it holds, `Terms` alone. A model has a `name` in the plan, the
// `model` that stands in the case file and what it `says` of itself there, its `keys`, the reason
// `why` it runs, a list of the terms that it `Makes`, and `fill`, which puts one into the slot.
#pragma once

#include "hyoryu/core/sweep.hpp"

#include <string_view>
#include <variant>

namespace hyoryu {

/// The table of a slot in the case file.
struct SlotTable {
    std::string_view key; // of [fluid]
    std::string_view meaning;
    std::string_view none; // what is said of the model "none", after the others
    std::string_view off;  // why no model runs
};

/// The terms that a model may put into its slot.
template <class... Term>
struct TermList {
};

/// A list of slots.
template <class... Slot>
struct SlotList {
};

/// Calls `f(slot)` for each slot of the list.
template <class... S>
constexpr void for_each(SlotList<S...>, auto&& f)
{
    (f(S{}), ...);
}

namespace detail {
template <class Model>
struct MadeBy {
    using type = typename Model::Makes;
};
template <>
struct MadeBy<Off> {
    using type = TermList<>;
};

template <class... Lists>
struct UnionOfTerms;
template <class... T>
struct UnionOfTerms<TermList<T...>> {
    using type = std::variant<T...>;
};
template <class... T, class... Rest>
struct UnionOfTerms<TermList<T...>, TermList<>, Rest...> : UnionOfTerms<TermList<T...>, Rest...> {
};
template <class... T, class U, class... V, class... Rest>
struct UnionOfTerms<TermList<T...>, TermList<U, V...>, Rest...>
    : std::conditional_t<(std::is_same_v<T, U> || ...),
                         UnionOfTerms<TermList<T...>, TermList<V...>, Rest...>,
                         UnionOfTerms<TermList<T..., U>, TermList<V...>, Rest...>> {
};

template <class Models>
struct TermsOfModels;
template <class... Models>
struct TermsOfModels<std::variant<Models...>>
    : UnionOfTerms<TermList<Off>, typename MadeBy<Models>::type...> {
};

template <class Found, class... Slots>
struct WithModels {
    using type = Found;
};
template <class... Found, class First, class... Rest>
struct WithModels<SlotList<Found...>, First, Rest...> : WithModels<SlotList<Found...>, Rest...> {
};
template <class... Found, class First, class... Rest>
requires requires
{
    typename First::Models;
}
struct WithModels<SlotList<Found...>, First, Rest...>
    : WithModels<SlotList<Found..., First>, Rest...> {};
template <class List>
struct SlotsWithModels;
template <class... Slots>
struct SlotsWithModels<SlotList<Slots...>> : WithModels<SlotList<>, Slots...> {
};
} // namespace detail

/// A variant of `Off` and all that the models make.
template <class Models>
using TermsOf = typename detail::TermsOfModels<Models>::type;

/// The slots of a list for which the user chooses a model.
template <class List>
using ModelSlots = typename detail::SlotsWithModels<List>::type;

/// The term that a slot holds: `effects[slot::viscosity]`.
template <class Slot>
struct HeldTerm {
    typename Slot::Terms term;
    constexpr auto& operator[](Slot) { return term; }
    constexpr const auto& operator[](Slot) const { return term; }
};
template <class List>
struct HeldTerms;
template <class... Slots>
struct HeldTerms<SlotList<Slots...>> : HeldTerm<Slots>... {
    using HeldTerm<Slots>::operator[]...;
};

/// The model that is chosen for a slot: `choices[slot::viscosity]`.
template <class Slot>
struct ChosenModel {
    typename Slot::Models model;
    constexpr auto& operator[](Slot) { return model; }
    constexpr const auto& operator[](Slot) const { return model; }
};
template <class List>
struct ChosenModels;
template <class... Slots>
struct ChosenModels<SlotList<Slots...>> : ChosenModel<Slots>... {
    using ChosenModel<Slots>::operator[]...;
};

} // namespace hyoryu
