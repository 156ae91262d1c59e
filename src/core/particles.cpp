// SPDX-License-Identifier: MIT
#include "hyoryu/core/particles.hpp"

#include <cstring>

namespace hyoryu {

namespace {

// Rows [0, order.size()) of `column` become the named ones; what stood behind `fluid_end` follows.
template <class T>
void permute(std::vector<T>& column, std::span<const std::int32_t> order, Index fluid_end,
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
    column.erase(column.begin() + rows, column.begin() + fluid_end);
}

} // namespace

void Particles::permute_fluid(std::span<const std::int32_t> order, std::span<std::byte> room)
{
    std::vector<std::byte> own;
    if (room.size() < order.size() * sizeof(Vec3)) {
        own.resize(order.size() * sizeof(Vec3));
        room = own;
    }
    const Index kept = static_cast<Index>(order.size());
    for_each(AllFields{}, [&](auto field) {
        if (has(field)) {
            permute(std::get<detail::index_in<decltype(field), AllFields>>(columns_), order,
                    fluid_.end, room);
        }
    });
    permute(id_, order, fluid_.end, room);
    permute(owner_, order, fluid_.end, room);
    const Index gone = fluid_.end - kept;
    fluid_.end = kept;
    wall_ = {wall_.begin - gone, wall_.end - gone};
    body_ = {body_.begin - gone, body_.end - gone};
}

std::vector<ColumnInfo> Particles::active_columns() const
{
    std::vector<ColumnInfo> columns;
    for_each(AllFields{}, [&](auto field) {
        if (has(field)) {
            columns.push_back({field.info, sizeof(typename decltype(field)::type),
                               of_fluid_alone<decltype(field)>});
        }
    });
    return columns;
}

std::size_t Particles::bytes() const
{
    const auto held = [](const auto& column) { return column.capacity() * sizeof(column[0]); };
    const std::size_t fields = std::apply(
        [&](const auto&... column) { return (std::size_t(0) + ... + held(column)); }, columns_);
    return fields + held(id_) + held(owner_);
}

} // namespace hyoryu
