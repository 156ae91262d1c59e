// SPDX-License-Identifier: MIT
// Communication of the processes that share a case. A rank is one of them. Every call is made by
// all ranks, in the same order.
#pragma once

#include "hyoryu/core/fixed_sum.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace hyoryu {

/// A message.
using Parcel = std::vector<std::byte>;

/// A number that is reduced over all ranks: to its sum, its largest value, or both.
struct Joined {
    FixedSum sum;
    double largest = -std::numeric_limits<double>::infinity();

    /// Adds the number of another rank. The largest is not-a-number if any is.
    void join(const Joined& other)
    {
        sum.add(other.sum);
        const double a = largest;
        const double b = other.largest; // a comparison that fails keeps what is not a number
        largest = b <= a ? a : (a <= b ? b : a + b);
    }
};

/// The connection of a rank with the others.
class Comm {
public:
    virtual ~Comm() = default;

    virtual int rank() const = 0;
    virtual int size() const = 0;

    /// Sends `out[r]` to rank r, and returns by rank what each sent to this one, itself included.
    /// Nothing is sent for an empty parcel.
    virtual std::vector<Parcel> exchange(std::vector<Parcel> out) = 0;
    /// The same where a rank knows how long the messages to it are: `in[r]` has the size of what
    /// rank r sends. The sizes need not be exchanged first.
    virtual void exchange(const std::vector<Parcel>& out, std::vector<Parcel>& in) = 0;
    /// The same exchange without waiting: `begin` starts it, `finish` waits for its end. In between
    /// a rank may compute and make other calls, but no second `begin`; `out` and `in` must not be
    /// touched. `in` is valid after `finish`.
    virtual void begin(const std::vector<Parcel>& out, std::vector<Parcel>& in) = 0;
    virtual void finish() = 0;

    /// Reduces each number over all ranks.
    virtual void join(std::span<Joined> numbers) = 0;
    /// Replaces each number by its sum over all ranks.
    virtual void add(std::span<std::int64_t> numbers) = 0;
};

/// Values that may be copied as bytes: numbers, vectors of Eigen, and structures of them.
template <class T>
concept Sendable = std::is_standard_layout_v<T> && std::is_trivially_destructible_v<T>;

/// Appends values to a parcel.
template <Sendable T>
void put(Parcel& parcel, std::span<const T> values)
{
    const std::size_t before = parcel.size();
    parcel.resize(before + values.size_bytes());
    if (!values.empty()) {
        std::memcpy(parcel.data() + before, static_cast<const void*>(values.data()),
                    values.size_bytes());
    }
}
template <Sendable T>
void put(Parcel& parcel, const T& value)
{
    put(parcel, std::span<const T>(&value, 1));
}

/// Takes values out of a parcel in the order in which they were put.
class Unpacking {
public:
    explicit Unpacking(std::span<const std::byte> parcel) : left_(parcel) {}

    template <Sendable T>
    void take(std::span<T> values)
    {
        expects(left_.size() >= values.size_bytes());
        if (!values.empty()) {
            std::memcpy(static_cast<void*>(values.data()), left_.data(), values.size_bytes());
        }
        left_ = left_.subspan(values.size_bytes());
    }
    template <Sendable T>
    T take()
    {
        T value{};
        take(std::span<T>(&value, 1));
        return value;
    }
    bool empty() const { return left_.empty(); }

private:
    std::span<const std::byte> left_;
};

/// Appends values and, before them, their number.
template <Sendable T>
void put_list(Parcel& parcel, std::span<const T> values)
{
    put(parcel, values.size());
    put(parcel, values);
}
template <Sendable T>
void put_list(Parcel& parcel, const std::vector<T>& values)
{
    put_list(parcel, std::span<const T>(values));
}
/// Takes such values and appends them to others.
template <Sendable T>
void take_more(Unpacking& from, std::vector<T>& values)
{
    const std::size_t before = values.size();
    values.resize(before + from.take<std::size_t>());
    from.take(std::span(values).subspan(before));
}
template <Sendable T>
std::vector<T> take_list(Unpacking& from)
{
    std::vector<T> values;
    take_more(from, values);
    return values;
}
inline void put_text(Parcel& parcel, std::string_view text)
{
    put_list(parcel, std::span<const char>(text));
}
inline std::string take_text(Unpacking& from)
{
    std::string text(from.take<std::size_t>(), '\0');
    from.take(std::span<char>(text));
    return text;
}

/// The values of all ranks, one rank after the other, and where those of this one are among them.
template <class T>
struct Gathered {
    std::vector<T> all;
    std::size_t own = 0; // the first of this rank
};
template <class T>
Gathered<T> gather(Comm& comm, std::span<const T> values)
{
    Parcel parcel;
    put(parcel, values);
    const auto ranks = static_cast<std::size_t>(comm.size());
    const std::vector<Parcel> in = comm.exchange(std::vector<Parcel>(ranks, parcel));
    Gathered<T> gathered;
    for (std::size_t r = 0; r < ranks; ++r) {
        if (static_cast<int>(r) == comm.rank()) {
            gathered.own = gathered.all.size();
        }
        const std::size_t before = gathered.all.size();
        gathered.all.resize(before + in[r].size() / sizeof(T));
        Unpacking(in[r]).take(std::span(gathered.all).subspan(before));
    }
    return gathered;
}

/// The values of all ranks; `comm` is null for one process.
template <class T>
std::vector<T> of_all_ranks(Comm* comm, std::vector<T> own)
{
    return comm == nullptr ? std::move(own) : gather(*comm, std::span<const T>(own)).all;
}

} // namespace hyoryu
