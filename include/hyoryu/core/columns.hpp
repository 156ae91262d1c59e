// SPDX-License-Identifier: MIT
// Operations on named arrays (columns): their length, a selection of rows, and concatenation.
#pragma once

#include "hyoryu/core/snapshot.hpp"

#include <cstdint>
#include <span>

namespace hyoryu {

/// Number of rows.
std::size_t rows_of(const Column& column);

/// A column with the rows of the given indices, in the order of the indices.
Column some_rows(const Column& column, std::span<const std::int32_t> rows);

/// Appends the rows of another column. Throws IoError if the two differ in name, type or
/// components.
void append_rows(Column& all, const Column& more);

/// Appends the points of another cloud. Throws IoError if the two have different columns.
void append_points(Cloud& all, const Cloud& more);

} // namespace hyoryu
