// SPDX-License-Identifier: MIT
#include "hyoryu/scene/filling_exchange.hpp"

#include <algorithm>
#include <numeric>

namespace hyoryu {

namespace {

// The order of rows by ascending numbers.
std::vector<std::size_t> order_of(const std::vector<std::int64_t>& numbers)
{
    std::vector<std::size_t> order(numbers.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::ranges::sort(order, {}, [&](std::size_t k) { return numbers[k]; });
    return order;
}

template <class T>
void put_some(Parcel& parcel, const std::vector<T>& values, const std::vector<std::size_t>& rows)
{
    std::vector<T> some;
    for (std::size_t k = 0; k < (values.empty() ? 0 : rows.size()); ++k) {
        some.push_back(values[rows[k]]);
    }
    put_list(parcel, some);
}

template <class T>
void rearrange(std::vector<T>& values, const std::vector<std::size_t>& order)
{
    std::vector<T> sorted;
    for (std::size_t k = 0; k < (values.empty() ? 0 : order.size()); ++k) {
        sorted.push_back(values[order[k]]);
    }
    values = std::move(sorted);
}

// The columns of the fluid and of the walls of fillings, the numbers first: f(column of each).
constexpr auto over_fluid = [](const auto& f, auto&... of) {
    f(of.fluid_number...);
    f(of.fluid...);
    f(of.fluid_velocity...);
    f(of.fluid_depth...);
    f(of.fluid_pressure...);
    f(of.fluid_cut...);
};
constexpr auto over_walls = [](const auto& f, auto&... of) {
    f(of.wall_number...);
    f(of.wall...);
    f(of.wall_owner...);
    f(of.wall_depth...);
};

void put(Parcel& parcel, const Filling& filling, const std::vector<std::size_t>& rows,
         const auto& over)
{
    over([&](const auto& column) { put_some(parcel, column, rows); }, filling);
}

void take(const Parcel& parcel, const auto& over, Filling& filling)
{
    Unpacking from(parcel);
    over([&](auto& column) { take_more(from, column); }, filling);
}

void sort(const std::vector<std::int64_t>& numbers, const auto& over, Filling& filling)
{
    const std::vector<std::size_t> order = order_of(numbers);
    over([&](auto& column) { rearrange(column, order); }, filling);
}

Filling exchange(Comm& comm, const Filling& filling,
                 const std::vector<std::vector<std::size_t>>& rows, const auto& over)
{
    std::vector<Parcel> out(rows.size());
    for (std::size_t rank = 0; rank < rows.size(); ++rank) {
        put(out[rank], filling, rows[rank], over);
    }
    Filling found;
    for (const Parcel& parcel : comm.exchange(std::move(out))) {
        take(parcel, over, found);
    }
    return found;
}

} // namespace

Filling exchange_fluid(Comm& comm, const Filling& filling,
                       const std::vector<std::vector<std::size_t>>& rows)
{
    Filling found = exchange(comm, filling, rows, over_fluid);
    sort(found.fluid_number, over_fluid, found);
    return found;
}

Filling fluid_of(const Filling& filling, const std::vector<std::size_t>& rows)
{
    Parcel parcel;
    put(parcel, filling, rows, over_fluid);
    Filling found;
    take(parcel, over_fluid, found);
    return found;
}

void join_fluid(const Filling& more, Filling& filling)
{
    over_fluid([](const auto& from, auto& to) { to.insert(to.end(), from.begin(), from.end()); },
               more, filling);
    sort(filling.fluid_number, over_fluid, filling);
}

void swap_fluid(Filling& a, Filling& b)
{
    over_fluid([](auto& one, auto& other) { one.swap(other); }, a, b);
}

void give_fluid(Comm& comm, const std::function<int(const Vec3&)>& owner, Filling& filling)
{
    const Index count = filling.fluid_count();
    std::vector<std::vector<std::size_t>> rows(at(comm.size()));
    for (std::size_t k = 0; k < filling.fluid.size(); ++k) {
        rows[at(owner(filling.fluid[k]))].push_back(k);
    }
    Filling own = exchange_fluid(comm, filling, rows);
    swap_fluid(own, filling);
    filling.fluid_elsewhere = count - static_cast<Index>(filling.fluid.size());
}

void give_walls_to_all(Comm& comm, const std::function<bool(std::int32_t)>& which, Filling& filling)
{
    const Index count = filling.wall_count();
    std::vector<std::size_t> rows;
    for (std::size_t k = 0; k < filling.wall.size(); ++k) {
        if (which(filling.wall_owner[k])) {
            rows.push_back(k);
        }
    }
    const auto ranks = at(comm.size());
    Filling all =
        exchange(comm, filling, std::vector<std::vector<std::size_t>>(ranks, rows), over_walls);
    sort(all.wall_number, over_walls, all);
    over_walls([](auto& one, auto& other) { one.swap(other); }, all, filling);
    filling.wall_elsewhere = count - static_cast<Index>(filling.wall.size());
}

} // namespace hyoryu
