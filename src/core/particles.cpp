// SPDX-License-Identifier: MIT
#include "hyoryu/core/particles.hpp"

#include <cstring>
#include <numeric>

namespace hyoryu {

namespace {

// Row k of the column becomes row from[k]; zero where that is -1.
template <class T>
void gather_column(ColumnValues<T>& column, std::span<const std::int32_t> from,
                   std::span<std::byte> room)
{
    const std::size_t rows = from.size();
    std::byte* const gathered = room.data();
    parallel_for(0, static_cast<Index>(rows), [&](Index k) {
        const auto to = static_cast<std::size_t>(k);
        std::byte* const place = gathered + to * sizeof(T);
        if (from[to] < 0) {
            std::memset(place, 0, sizeof(T));
        } else {
            const void* const row = &column[from[to]];
            std::memcpy(place, row, sizeof(T));
        }
    });
    if (column.capacity() < rows) { // by itself a vector would take twice what it had
        column = {};
        column.reserve(rows + rows / 8);
    }
    column.resize(rows);
    parallel_for(0, static_cast<Index>(rows), [&](Index k) {
        const auto to = static_cast<std::size_t>(k);
        std::memcpy(static_cast<void*>(&column[to]), gathered + to * sizeof(T), sizeof(T));
    });
}

} // namespace

void Store::reset(Index rows)
{
    columns_.clear();
    id_.assign(static_cast<std::size_t>(rows), 0);
    owner_.assign(kind_ == Kind::fluid ? 0 : id_.size(), 0);
}

void Store::reset_like(const Store& other, Index rows)
{
    const auto count = static_cast<std::size_t>(rows);
    id_.assign(count, 0);
    owner_.assign(kind_ == Kind::fluid ? 0 : count, 0);
    if (!std::ranges::equal(columns_, other.columns_, {}, &StoredColumn::field,
                            &StoredColumn::field)) {
        columns_ = other.columns_;
    }
    for_each_column([&]<class T>(const FieldInfo&, ColumnValues<T>& values) {
        values.assign(count, uniform<T>(0));
    });
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

void Store::gather(std::span<const std::int32_t> from, std::span<std::byte> room)
{
    std::vector<std::byte> own;
    if (room.size() < from.size() * sizeof(Vec3)) {
        own.resize(from.size() * sizeof(Vec3));
        room = own;
    }
    for_each_column([&](const FieldInfo&, auto& values) { gather_column(values, from, room); });
    gather_column(id_, from, room);
    if (kind_ != Kind::fluid) {
        gather_column(owner_, from, room);
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
            auto known = std::ranges::find_if(
                columns, [&](const ColumnInfo& column) { return column.field.name == field.name; });
            if (known == columns.end()) {
                known = columns.insert(known, {field, sizeof(values[0])});
            }
            (store == &particles.fluid ? known->of_fluid : known->of_solids) = true;
        });
    }
    return columns;
}

std::size_t bytes_of(const Particles& particles)
{
    return particles.fluid.bytes() + particles.wall.bytes() + particles.body.bytes();
}

} // namespace hyoryu
