// SPDX-License-Identifier: MIT
#include "hyoryu/core/particles.hpp"

namespace hyoryu {

namespace {

// Rows [0, order.size()) of `column` become the named ones; what stood behind `fluid_end` follows.
template <class T>
void permute(std::vector<T>& column, std::span<const std::int32_t> order, Index fluid_end)
{
    std::vector<T> sorted(order.size());
    parallel_for(0, static_cast<Index>(order.size()), [&](Index k) {
        const auto at = static_cast<std::size_t>(k);
        sorted[at] = column[static_cast<std::size_t>(order[at])];
    });
    std::copy(sorted.begin(), sorted.end(), column.begin());
    column.erase(column.begin() + static_cast<Index>(order.size()), column.begin() + fluid_end);
}

} // namespace

void Particles::permute_fluid(std::span<const std::int32_t> order)
{
    const Index kept = static_cast<Index>(order.size());
    for_each(AllFields{}, [&](auto field) {
        if (has(field)) {
            permute(std::get<detail::index_in<decltype(field), AllFields>>(columns_), order,
                    fluid_.end);
        }
    });
    permute(id_, order, fluid_.end);
    permute(owner_, order, fluid_.end);
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
            columns.push_back({field.info, sizeof(typename decltype(field)::type)});
        }
    });
    return columns;
}

} // namespace hyoryu
