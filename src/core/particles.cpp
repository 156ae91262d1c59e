// SPDX-License-Identifier: MIT
#include "hyoryu/core/particles.hpp"

#include <cstring>
#include <numeric>

namespace hyoryu {

namespace {

// Row k of the column becomes row order[k].
template <class T>
void permute_column(ColumnValues<T>& column, std::span<const std::int32_t> order,
                    std::span<std::byte> room)
{
    const auto rows = static_cast<Index>(order.size());
    std::byte* const sorted = room.data();
    parallel_for(0, rows, [&](Index k) {
        const auto at = static_cast<std::size_t>(k);
        std::memcpy(sorted + at * sizeof(T), &column[static_cast<std::size_t>(order[at])],
                    sizeof(T));
    });
    parallel_for(0, rows, [&](Index k) {
        const auto at = static_cast<std::size_t>(k);
        std::memcpy(static_cast<void*>(&column[at]), sorted + at * sizeof(T), sizeof(T));
    });
    column.resize(order.size());
}

} // namespace

void Store::reset(Index rows)
{
    columns_.clear();
    id_.assign(static_cast<std::size_t>(rows), 0);
    owner_.assign(kind_ == Kind::fluid ? 0 : id_.size(), 0);
}

ColumnPointers Store::pointers()
{
    ColumnPointers all;
    for_each_column([&]<class T>(const FieldInfo& field, ColumnValues<T>& values) {
        if constexpr (std::is_same_v<T, Vec3>) {
            all.add(&field, values.empty() ? nullptr : values.front().data());
        } else {
            all.add(&field, values.data());
        }
    });
    return all;
}

void Store::permute(std::span<const std::int32_t> order, std::span<std::byte> room)
{
    std::vector<std::byte> own;
    if (room.size() < order.size() * sizeof(Vec3)) {
        own.resize(order.size() * sizeof(Vec3));
        room = own;
    }
    for_each_column([&](const FieldInfo&, auto& values) { permute_column(values, order, room); });
    permute_column(id_, order, room);
    if (kind_ != Kind::fluid) {
        permute_column(owner_, order, room);
    }
}

std::size_t Store::bytes() const
{
    const auto held = [](const auto& column) { return column.capacity() * sizeof(column[0]); };
    std::size_t sum = held(id_) + held(owner_);
    for_each_column([&](const FieldInfo&, const auto& values) { sum += held(values); });
    return sum;
}

void reset(Particles& particles, Index fluid, Index wall, Index body)
{
    particles.fluid.reset(fluid);
    particles.wall.reset(wall);
    particles.body.reset(body);
    std::int64_t next = 0;
    for (Store* store : {&particles.fluid, &particles.wall, &particles.body}) {
        std::iota(store->id().begin(), store->id().end(), next);
        next += store->size();
    }
}

std::vector<ColumnInfo> active_columns(const Particles& particles)
{
    std::vector<ColumnInfo> columns;
    for (const Store* store : {&particles.fluid, &particles.wall, &particles.body}) {
        store->for_each_column([&](const FieldInfo& field, const auto& values) {
            const auto known = [&](const ColumnInfo& column) {
                return column.field.name == field.name;
            };
            if (std::ranges::none_of(columns, known)) {
                columns.push_back({field, sizeof(values[0])});
            }
        });
    }
    return columns;
}

std::size_t bytes_of(const Particles& particles)
{
    return particles.fluid.bytes() + particles.wall.bytes() + particles.body.bytes();
}

} // namespace hyoryu
