// SPDX-License-Identifier: MIT
// Columns of values in messages, and put together from those of several ranks.
#pragma once

#include "hyoryu/core/snapshot.hpp"
#include "hyoryu/ranks/comm.hpp"

namespace hyoryu {

std::size_t rows_of(const Column& column);

/// The rows of these numbers, in their order.
Column some_rows(const Column& column, std::span<const std::int32_t> rows);

/// Appends rows. Throws IoError if the two differ in type or components.
void append_rows(Column& all, const Column& more);

void put_column(Parcel& parcel, const Column& column);
Column take_column(Unpacking& from);

void put_arrays(Parcel& parcel, const Snapshot& snapshot);
Snapshot take_arrays(Unpacking& from);

} // namespace hyoryu
