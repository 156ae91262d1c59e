// SPDX-License-Identifier: MIT
// The words in which the keys of the case file are declared, once for each struct (`keys_of`), and
// the base class of the visitors of such a declaration. There are three: the reader
// (`TableReader`), the writer of a resolved case (`KeyWriter`), and the collector of the table of
// keys (`KeyTable`).
#pragma once

#include "hyoryu/core/types.hpp"
#include "hyoryu/scene/parameter.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace hyoryu {

/// The default of a key as a text, or one of the words below; without one it is the value that the
/// member begins with.
using Default = std::optional<std::string_view>;
inline constexpr std::string_view required = "required"; // to be given in every case
inline constexpr std::string_view needed = "needed";     // to be given wherever it is asked for
inline constexpr std::string_view no_default{};

/// The type is `Struct`, or const `Struct`, which the writer visits.
template <class T, class Struct>
concept Is = std::same_as<std::remove_const_t<T>, Struct>;

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_optional<T&> = is_optional<T>;
template <class T>
inline constexpr bool is_optional<const T> = is_optional<T>;

/// Length of an array, or of the array that an optional may hold.
template <class T>
inline constexpr std::size_t list_length = 0;
template <class T, std::size_t n>
inline constexpr std::size_t list_length<std::array<T, n>> = n;
template <class T>
inline constexpr std::size_t list_length<std::optional<T>> = list_length<T>;
template <class T>
inline constexpr std::size_t list_length<const T> = list_length<T>;

/// A key without the brackets of lists: "body[2].size" and "body[].size" become "body.size".
std::string plain_key(std::string_view key);

/// Visits the keys of a table: calls `what(visitor, ...)` if it is callable, else visits the keys
/// of the struct `what`.
template <class Visitor, class What, class... Context>
void visit_keys(Visitor& keys, What&& what, Context&&... context)
{
    if constexpr (std::invocable<What&, Visitor&, Context&...>) {
        what(keys, context...);
    } else {
        keys_of(keys, what, context...);
    }
}

template <std::size_t k = 0, class... Ts>
void hold(std::variant<Ts...>& value, std::size_t index)
{
    if constexpr (k < sizeof...(Ts)) {
        if (index != k) {
            hold<k + 1>(value, index);
        } else if (value.index() != k) {
            value.template emplace<k>();
        }
    }
}

/// A number, or the name of what holds numbers.
struct NumberOrName {
    std::optional<double> number;
    std::string name; // empty beside a number
};

/// Each word declares one key: its name, the member that it stands for, its unit and what it means.
/// A visitor defines `key` for all values, `pick` for one of some names, `table` and `tables`; it
/// also overrides the functions below that it needs otherwise.
template <class Visitor>
class KeyWords {
    using Text = std::string_view;
    friend Visitor; // a class that passes another one than itself does not compile
    KeyWords() = default;

public:
    void number(Text name, auto& member, Text unit, Text meaning, Default fallback = {})
    {
        self().key(row(name, ValueKind::number, unit, meaning), member, fallback);
    }
    void positive(Text name, auto& member, Text unit, Text meaning, Default fallback = {})
    {
        Parameter rule = bounded(name, unit, 0, unbounded, "> 0", meaning);
        rule.minimum_excluded = true;
        self().key(rule, member, fallback);
    }
    void not_negative(Text name, auto& member, Text unit, Text meaning, Default fallback = {})
    {
        self().key(bounded(name, unit, 0, unbounded, ">= 0", meaning), member, fallback);
    }
    void not_positive(Text name, auto& member, Text unit, Text meaning, Default fallback = {})
    {
        self().key(bounded(name, unit, -unbounded, 0, "<= 0", meaning), member, fallback);
    }
    /// A number, or the name of what holds numbers.
    void number_or_name(Text name, auto& member, Text unit, Text meaning, Default fallback = {})
    {
        self().key(row(name, ValueKind::number_or_name, unit, meaning), member, fallback);
    }
    /// A number without unit; `bounds` as the user reads them.
    void between(Text name, auto& member, double minimum, double maximum, Text bounds, Text meaning,
                 Default fallback = {})
    {
        self().key(bounded(name, "", minimum, maximum, bounds, meaning), member, fallback);
    }
    void fraction(Text name, auto& member, Text meaning, Default fallback = {})
    {
        between(name, member, 0, 1, "0 .. 1", meaning, fallback);
    }
    /// A whole number, or a list of three.
    template <class T>
    void integer(Text name, T& member, double minimum, double maximum, Text bounds, Text meaning,
                 Default fallback = {})
    {
        constexpr bool single = std::integral<T>;
        Parameter rule = bounded(name, "", minimum, maximum, bounds, meaning);
        rule.kind = single ? ValueKind::integer : ValueKind::integers;
        rule.shortest = rule.longest = single ? 0 : 3;
        self().key(rule, member, fallback);
    }
    void flag(Text name, auto& member, Text meaning)
    {
        self().key(row(name, ValueKind::boolean, "", meaning), member, {});
    }
    void text(Text name, auto& member, Text meaning, Default fallback = no_default)
    {
        self().key(row(name, ValueKind::text, "", meaning), member, fallback);
    }
    /// Some of the choices; any texts without choices.
    void texts(Text name, auto& member, std::vector<Text> choices, Text meaning,
               Default fallback = {})
    {
        constexpr int most = 100;
        Parameter rule = row(name, ValueKind::texts, "", meaning);
        rule.choices = std::move(choices);
        rule.longest = most;
        self().key(rule, member, fallback);
    }
    /// A list of `count` texts.
    void text_list(Text name, auto& member, int count, Text meaning, Default fallback = {})
    {
        Parameter rule = row(name, ValueKind::texts, "", meaning);
        rule.shortest = rule.longest = count;
        self().key(rule, member, fallback);
    }
    /// Flags as a list of the names of those that are set.
    template <class Flags, std::size_t n>
    void flags(Text name, Flags& member, const Text (&names)[n], Text meaning)
    {
        std::vector<std::string> set;
        for (std::size_t k = 0; k < n; ++k) {
            if (member[k]) {
                set.emplace_back(names[k]);
            }
        }
        texts(name, set, {names, names + n}, meaning);
        if constexpr (!Visitor::writes) {
            for (std::size_t k = 0; k < n; ++k) {
                member[k] = std::ranges::find(set, names[k]) != set.end();
            }
        }
    }
    /// Three numbers, or at least `shortest` numbers if the vector may also have two dimensions.
    void vector(Text name, auto& member, Text unit, Text meaning, Default fallback = {},
                int shortest = 3)
    {
        Parameter rule = row(name, ValueKind::vector, unit, meaning);
        rule.shortest = shortest;
        rule.longest = 3;
        self().key(rule, member, fallback);
    }
    /// A place seen from above: x, and in three dimensions y.
    void plan_place(Text name, std::vector<double>& member, Text meaning)
    {
        Parameter rule = row(name, ValueKind::vector, "m", meaning);
        rule.shortest = 1;
        rule.longest = 2;
        self().key(rule, member, needed);
    }
    /// A vector in space: its y is zero in two dimensions.
    void planar(Text name, auto& member, Text unit, Text meaning, Default fallback = {},
                int shortest = 3)
    {
        self().vector(name, member, unit, meaning, fallback, shortest);
    }
    /// A vector of any length that becomes the unit vector along it.
    void direction(Text name, auto& member, Text meaning, Default fallback = {})
    {
        self().planar(name, member, "", meaning, fallback);
    }
    /// A list of as many numbers as the array has.
    template <class Numbers>
    void numbers(Text name, Numbers& member, Text unit, Text meaning, Default fallback = {})
    {
        constexpr auto count = static_cast<int>(list_length<Numbers>);
        Parameter rule = row(name, ValueKind::vector, unit, meaning);
        rule.shortest = rule.longest = count;
        self().key(rule, member, fallback);
    }
    void quaternion(Text name, auto& member, Text meaning)
    {
        Parameter rule = row(name, ValueKind::vector, "", meaning);
        rule.shortest = rule.longest = 4;
        self().key(rule, member, no_default);
    }
    /// Numbers or vectors, one for each point of a path of at least `shortest` points.
    template <class Path>
    void path(Text name, Path& member, Text unit, Text meaning, Default fallback = needed,
              int shortest = 2)
    {
        constexpr int most_points = 1000000;
        constexpr bool scalar = std::same_as<typename Path::value_type, double>;
        Parameter rule = row(name, scalar ? ValueKind::vector : ValueKind::vectors, unit, meaning);
        rule.shortest = shortest;
        rule.longest = most_points;
        self().key(rule, member, fallback);
    }
    /// One of the names; the member holds its index. Returns false if the value is mistaken.
    template <class T>
    bool choice(Text name, T& member, std::vector<Text> names, Text meaning, Default fallback = {})
    {
        auto index = static_cast<std::size_t>(member);
        const bool known =
            self().pick(choice_row(name, std::move(names), meaning), index, fallback);
        if constexpr (!Visitor::writes) {
            member = static_cast<T>(index);
        }
        return known;
    }
    /// One of the names, with keys of its own that `what` declares when it is called with the
    /// number of the name; false if it is mistaken.
    bool alternatives(Text name, std::size_t& index, std::vector<Text> names, Text meaning,
                      Default fallback, auto&& what)
    {
        const std::size_t count = names.size();
        const bool known =
            self().pick(choice_row(name, std::move(names), meaning), index, fallback);
        if (known) {
            self().each_choice(count, index, what);
        }
        return known;
    }
    /// A rule over several keys: only the reader calls it, with itself before the arguments.
    template <class... Arguments>
    void rule(Arguments&&... /*function_and_arguments*/)
    {
    }
    /// The table of an effect.
    void effect(Text name, Text meaning, auto&& what) { self().table(name, meaning, what); }
    /// Makes a variant hold its alternative of that number, where it does not yet.
    static void select(auto& value, std::size_t index) { hold(value, index); }
    /// Whether keys have a meaning in a case with that condition: the table lists them in any case.
    static bool applies(bool condition) { return condition; }
    /// Whether a key is given, sound or not.
    static bool gives(Text /*name*/) { return false; }
    /// Whether the writer writes keys.
    static bool shows(bool /*condition*/) { return true; }
    /// Lists a table before the keys that stand between its name and its own keys.
    void heading(Text /*name*/, Text /*meaning*/) {}

    static void each_choice(std::size_t /*count*/, std::size_t chosen, auto&& what)
    {
        what(chosen);
    }

protected:
    static Parameter row(Text name, ValueKind kind, Text unit, Text meaning)
    {
        return {.key = std::string(name), .kind = kind, .unit = unit, .meaning = meaning};
    }
    static Parameter choice_row(Text name, std::vector<Text> names, Text meaning)
    {
        Parameter rule = row(name, ValueKind::choice, "", meaning);
        rule.choices = std::move(names);
        return rule;
    }

private:
    static constexpr double unbounded = 1e300;

    Visitor& self() { return static_cast<Visitor&>(*this); }
    static Parameter bounded(Text name, Text unit, double minimum, double maximum, Text bounds,
                             Text meaning)
    {
        Parameter rule = row(name, ValueKind::number, unit, meaning);
        rule.bounds = bounds;
        rule.minimum = minimum;
        rule.maximum = maximum;
        return rule;
    }
};

} // namespace hyoryu
