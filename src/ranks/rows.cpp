// SPDX-License-Identifier: MIT
#include "hyoryu/ranks/rows.hpp"

#include <numeric>

namespace hyoryu {

void put_rows(Parcel& parcel, const Store& store, std::span<const std::int32_t> rows)
{
    const auto put_column = [&](const auto& values) {
        constexpr std::size_t bytes = sizeof(values[0]);
        std::size_t next = parcel.size();
        parcel.resize(next + bytes * rows.size());
        for (const std::int32_t row : rows) {
            std::memcpy(&parcel[next], static_cast<const void*>(&values[at(row)]), bytes);
            next += bytes;
        }
    };
    store.for_each_column([&](const FieldInfo&, const auto& values) { put_column(values); });
    put_column(store.id());
    if (!store.owner().empty()) {
        put_column(store.owner());
    }
}

void take_rows(Unpacking& from, Store& store, std::span<const std::int32_t> rows)
{
    const auto take_column = [&](auto&& values) {
        using T = std::remove_cvref_t<decltype(values[0])>;
        for (const std::int32_t row : rows) {
            values[at(row)] = from.take<T>();
        }
    };
    store.for_each_column([&](const FieldInfo&, auto& values) { take_column(values); });
    take_column(store.id());
    if (!store.owner().empty()) {
        take_column(store.owner());
    }
}

std::vector<std::int32_t> rows_from(Index first, Index count)
{
    std::vector<std::int32_t> rows(at(count));
    std::iota(rows.begin(), rows.end(), static_cast<std::int32_t>(first));
    return rows;
}

} // namespace hyoryu
