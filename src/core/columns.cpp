// SPDX-License-Identifier: MIT
#include "hyoryu/core/columns.hpp"

#include "hyoryu/core/error.hpp"

namespace hyoryu {

std::size_t rows_of(const Column& column)
{
    return std::visit([](const auto& values) { return values.size(); }, column.values) /
           static_cast<std::size_t>(column.components);
}

Column some_rows(const Column& column, std::span<const std::int32_t> rows)
{
    Column some{column.name, column.unit, column.components, {}};
    std::visit(
        [&]<class T>(const std::vector<T>& values) {
            std::vector<T> of_rows;
            of_rows.reserve(rows.size() * static_cast<std::size_t>(column.components));
            for (const std::int32_t row : rows) {
                const auto first = values.begin() + std::ptrdiff_t{row} * column.components;
                of_rows.insert(of_rows.end(), first, first + column.components);
            }
            some.values = std::move(of_rows);
        },
        column.values);
    return some;
}

void append_rows(Column& all, const Column& more)
{
    if (all.name != more.name || all.values.index() != more.values.index() ||
        all.components != more.components) {
        throw IoError("the array `" + all.name + "` is not the same in all parts");
    }
    std::visit(
        [&]<class T>(std::vector<T>& values) {
            const auto& others = std::get<std::vector<T>>(more.values);
            values.insert(values.end(), others.begin(), others.end());
        },
        all.values);
}

void append_points(Cloud& all, const Cloud& more)
{
    if (all.columns.size() != more.columns.size()) {
        throw IoError("the parts of `" + all.name + "` have different arrays");
    }
    all.points.insert(all.points.end(), more.points.begin(), more.points.end());
    for (std::size_t k = 0; k < all.columns.size(); ++k) {
        append_rows(all.columns[k], more.columns[k]);
    }
}

} // namespace hyoryu
