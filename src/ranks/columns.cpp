// SPDX-License-Identifier: MIT
#include "hyoryu/ranks/columns.hpp"

namespace hyoryu {

namespace {

template <std::size_t index = 0>
void take_values(Unpacking& from, std::size_t which, Column& column)
{
    if constexpr (index < std::variant_size_v<decltype(column.values)>) {
        if (which != index) {
            return take_values<index + 1>(from, which, column);
        }
        using Values = std::variant_alternative_t<index, decltype(column.values)>;
        column.values = take_list<typename Values::value_type>(from);
    }
}

} // namespace

void put_column(Parcel& parcel, const Column& column)
{
    put_text(parcel, column.name);
    put_text(parcel, column.unit);
    put(parcel, column.components);
    put(parcel, column.values.index());
    std::visit([&](const auto& values) { put_list(parcel, values); }, column.values);
}

Column take_column(Unpacking& from)
{
    Column column{take_text(from), take_text(from), from.take<int>(), {}};
    take_values(from, from.take<std::size_t>(), column);
    return column;
}

void put_arrays(Parcel& parcel, const Snapshot& snapshot)
{
    put(parcel, snapshot.arrays.size());
    for (const auto& [name, column] : snapshot.arrays) {
        put_text(parcel, name);
        put_column(parcel, column);
    }
}

Snapshot take_arrays(Unpacking& from)
{
    Snapshot snapshot;
    for (auto left = from.take<std::size_t>(); left > 0; --left) {
        std::string name = take_text(from);
        snapshot.arrays.emplace(std::move(name), take_column(from));
    }
    return snapshot;
}

} // namespace hyoryu
