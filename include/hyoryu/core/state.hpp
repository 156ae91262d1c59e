// SPDX-License-Identifier: MIT
// State as named datasets. A function template `describe(state, part)` names each quantity once,
// with its unit and its place; a StateWriter in `state` stores them, a StateReader takes them back.
// A StateArray creates a single dataset; with it a state is written without being copied as a
// whole. No quantity depends on the order or the number of others.
#pragma once

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/snapshot.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace hyoryu {

/// How a value is stored: `components` numbers of one type. Whole numbers of other types are stored
/// in 64 bits.
template <class T>
struct Encoded {
    static constexpr bool is_native = std::is_floating_point_v<T> ||
                                      std::is_same_v<T, std::int32_t> ||
                                      std::is_same_v<T, std::int64_t>;
    using Number = std::conditional_t<is_native, T, std::int64_t>;
    static constexpr int components = 1;
    static std::array<Number, 1> put(const T& value) { return {static_cast<Number>(value)}; }
    static T get(const Number* n) { return static_cast<T>(*n); }
};
template <>
struct Encoded<Vec3> {
    using Number = double;
    static constexpr int components = 3;
    static std::array<double, 3> put(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
    static Vec3 get(const double* n) { return {n[0], n[1], n[2]}; }
};
template <>
struct Encoded<Quat> {
    using Number = double;
    static constexpr int components = 4;
    static std::array<double, 4> put(const Quat& q) { return {q.w(), q.x(), q.y(), q.z()}; }
    static Quat get(const double* n) { return {n[0], n[1], n[2], n[3]}; }
};
template <std::size_t n>
struct Encoded<std::array<int, n>> {
    using Number = std::int32_t;
    static constexpr int components = n;
    static std::array<int, n> put(const std::array<int, n>& values) { return values; }
    static std::array<int, n> get(const Number* from)
    {
        std::array<int, n> values{};
        std::copy_n(from, n, values.begin());
        return values;
    }
};

/// The type of a member of the elements of a range.
template <class Range, class Member>
using MemberOf =
    std::remove_cvref_t<std::invoke_result_t<Member, decltype(*std::declval<Range&>().begin())>>;

/// The dataset with a member of each element of a range.
template <class Range, class Member>
Column stored_column(const std::string& name, const std::string& unit, const Range& range,
                     Member member)
{
    using Value = Encoded<MemberOf<const Range, Member>>;
    std::vector<typename Value::Number> numbers;
    numbers.reserve(range.size() * Value::components);
    for (const auto& element : range) {
        const auto some = Value::put(std::invoke(member, element));
        numbers.insert(numbers.end(), some.begin(), some.end());
    }
    return {name, unit, Value::components, std::move(numbers)};
}

/// Base of the classes that read a state through `describe`. `Visitor` is the derived class; it
/// defines `each(name, unit, range, member)`, which handles one dataset; one that reads also sizes
/// lists in `resize`.
template <class Visitor>
class StateVisitor {
public:
    static constexpr bool reads = false;

    /// One value.
    void operator()(const std::string& name, const std::string& unit, auto&& value)
    {
        self().each(name, unit, std::span(&value, 1), std::identity());
    }
    /// The values of a range whose length the case gives.
    template <class T>
    void values(const std::string& name, const std::string& unit, std::span<T> range)
    {
        self().each(name, unit, range, std::identity());
    }
    /// A list whose length is part of the state.
    void list(const std::string& name, const std::string& unit, auto& list)
    {
        self().resize(name, list, std::identity());
        self().each(name, unit, list, std::identity());
    }
    /// Before the members of a list whose length is part of the state: one of them.
    template <class Range, class Member>
    void resize(const std::string&, const Range&, Member)
    {
    }

private:
    friend Visitor;
    StateVisitor() = default;

    Visitor& self() { return static_cast<Visitor&>(*this); }
};

/// Stores a state in a snapshot.
class StateWriter : public StateVisitor<StateWriter> {
public:
    explicit StateWriter(Snapshot& snapshot) : snapshot_(&snapshot) {}

    /// A member of each element of a range whose length the case gives.
    template <class Range, class Member>
    void each(const std::string& name, const std::string& unit, const Range& range, Member member)
    {
        snapshot_->arrays[name] = stored_column(name, unit, range, member);
    }

private:
    Snapshot* snapshot_;
};

/// Collects the sizes of all datasets of a state.
class StateSizes : public StateVisitor<StateSizes> {
public:
    template <class Range, class Member>
    void each(const std::string& name, const std::string&, const Range& range, Member)
    {
        using Value = Encoded<MemberOf<const Range, Member>>;
        bytes[name] = range.size() * Value::components * sizeof(typename Value::Number);
    }

    std::map<std::string, std::size_t> bytes; // by name [B]
};

/// Creates the dataset with the given name.
class StateArray : public StateVisitor<StateArray> {
public:
    explicit StateArray(const std::string& name) : name_(&name) {}

    template <class Range, class Member>
    void each(const std::string& name, const std::string& unit, const Range& range, Member member)
    {
        if (name == *name_) {
            column = stored_column(name, unit, range, member);
        }
    }

    Column column;

private:
    const std::string* name_;
};

/// A snapshot as a StateOnDemand: each array is moved out when it is requested.
inline StateOnDemand on_demand(Snapshot snapshot)
{
    StateOnDemand state{.bytes = {}, .array = {}, .texts = std::move(snapshot.texts)};
    for (const auto& [name, column] : snapshot.arrays) {
        state.bytes[name] = std::visit(
            [](const auto& values) { return values.size() * sizeof(values[0]); }, column.values);
    }
    state.array = [arrays = std::move(snapshot.arrays)](const std::string& name) mutable {
        return std::move(arrays.extract(name).mapped());
    };
    return state;
}

/// Takes a state from a snapshot. Throws IoError if a dataset is missing or has another type or
/// length than the case needs.
class StateReader : public StateVisitor<StateReader> {
public:
    static constexpr bool reads = true;

    explicit StateReader(const Snapshot& snapshot) : snapshot_(&snapshot) {}

    template <class Range, class Member>
    void each(const std::string& name, const std::string&, Range&& range, Member member)
    {
        using Value = Encoded<MemberOf<Range, Member>>;
        const auto& numbers = numbers_of<typename Value::Number>(name);
        if (numbers.size() != range.size() * Value::components) {
            throw IoError("`" + name + "` of the checkpoint has " + std::to_string(numbers.size()) +
                          " numbers, expected " + std::to_string(range.size() * Value::components) +
                          ": it belongs to another case");
        }
        const auto* next = numbers.data();
        for (auto&& element : range) {
            std::invoke(member, element) = Value::get(next);
            next += Value::components;
        }
    }
    template <class Range, class Member>
    void resize(const std::string& name, Range& range, Member)
    {
        using Value = Encoded<MemberOf<Range, Member>>;
        range.resize(numbers_of<typename Value::Number>(name).size() / Value::components);
    }

private:
    template <class Number>
    const std::vector<Number>& numbers_of(const std::string& name) const
    {
        const auto found = snapshot_->arrays.find(name);
        const auto* numbers = found == snapshot_->arrays.end()
                                  ? nullptr
                                  : std::get_if<std::vector<Number>>(&found->second.values);
        if (numbers == nullptr) {
            throw IoError("the checkpoint has no `" + name + "`: it belongs to another case");
        }
        return *numbers;
    }

    const Snapshot* snapshot_;
};

} // namespace hyoryu
